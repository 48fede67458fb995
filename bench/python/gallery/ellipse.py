"""Contact ellipse and pressure of one ball over its load, on screw and nut."""

import sys

import matplotlib.pyplot as plt
import numpy as np

import epas_friction as ef

design = ef.Design.built_in("lin-4.1")
load = np.geomspace(0.1, 2000.0, 300)

figure, (axes, pressure) = plt.subplots(1, 2, figsize=(9, 4))
for groove, colour in [("screw", "C0"), ("nut", "C1")]:
    ellipse = design.ellipse(groove, load)
    axes.loglog(load, 1e6 * ellipse.semi_major, colour, label=f"{groove}, semi-major")
    axes.loglog(load, 1e6 * ellipse.semi_minor, colour + "--", label=f"{groove}, semi-minor")
    pressure.semilogx(load, 1e-9 * ellipse.max_pressure, colour, label=groove)
axes.set(xlabel="load of the contact (N)", ylabel="semi-axis (µm)")
pressure.set(xlabel="load of the contact (N)", ylabel="largest pressure (GPa)")
axes.legend()
pressure.legend()
figure.tight_layout()
figure.savefig(sys.argv[1] + "/ellipse.svg")
