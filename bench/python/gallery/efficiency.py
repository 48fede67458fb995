"""Efficiency over the lead angle for three friction coefficients: sliding and rolling balls, both directions."""

import sys

import matplotlib.pyplot as plt
import numpy as np

import epas_friction as ef

lead_angle = np.linspace(1e-3, 1.2, 600)
friction = np.array([0.05, 0.1, 0.2])[:, None]
efficiency = ef.efficiency(lead_angle, np.pi / 4, friction, 0.16)

figure, axis = plt.subplots(figsize=(7, 4.5))
for row, coefficient in enumerate(friction.ravel()):
    drive = np.where(efficiency.locked_drive[row], np.nan, efficiency.sliding_drive[row])
    backdrive = np.where(efficiency.locked_backdrive[row], np.nan, efficiency.sliding_backdrive[row])
    axis.plot(np.degrees(lead_angle), drive, f"C{row}", label=f"friction {coefficient}: sliding, drive")
    axis.plot(np.degrees(lead_angle), backdrive, f"C{row}--", label="sliding, back-drive")
    axis.plot(np.degrees(lead_angle), efficiency.rolling_screw[row], f"C{row}:", label="rolling")
axis.set(xlabel="lead angle (degrees)", ylabel="efficiency", ylim=(0.0, 1.0))
axis.legend(fontsize="small")
figure.tight_layout()
figure.savefig(sys.argv[1] + "/efficiency.svg")
