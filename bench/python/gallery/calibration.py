"""A measured trace to constants: the torque as measured and as fitted, and the parameters with their 95 % intervals."""

import sys

import matplotlib.pyplot as plt
import numpy as np

import epas_friction as ef

trace = ef.reference.measured_trace("vehicle", seed=1)
told = ef.calibrate(trace, ef.Design.built_in("lin-4.1"), models=False)

figure, (fit, intervals) = plt.subplots(2, 1, figsize=(8, 7))
fit.plot(told.time, told.measured, "C7", linewidth=0.8, label="measured")
fit.plot(told.time, told.model, "C0", linewidth=0.8, label="fitted")
fit.set(xlabel="time (s)", ylabel="motor torque on the nut (N m)", title=f"relative error {told.relative_error:.2%}")
fit.legend()
found = [one for one in told.parameters.values() if not one.fixed and np.isfinite([one.low, one.high]).all() and one.value != 0.0]
for place, one in enumerate(found):
    low, high = one.low / one.value - 1.0, one.high / one.value - 1.0
    intervals.plot([100.0 * low, 100.0 * high], [place, place], "C0|-")
intervals.set_yticks(range(len(found)), [f"{one.name} = {one.value:.4g} {one.unit}" for one in found])
intervals.set_xlabel("95 % interval (% of the value)")
intervals.set_xscale("symlog", linthresh=1.0)
figure.tight_layout()
figure.savefig(sys.argv[1] + "/calibration.svg")
