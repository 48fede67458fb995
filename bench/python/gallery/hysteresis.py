"""Friction that remembers: reversals of growing size under 1 kN, over the nut's angle."""

import sys

import matplotlib.pyplot as plt
import numpy as np

import epas_friction as ef

time = np.arange(40_000) * 1e-4
amplitude = np.linspace(2e-4, 0.03, time.size)
angle = amplitude * np.sin(2.0 * np.pi * 2.0 * time)
nut_speed = np.gradient(angle, time)

design = ef.Design.built_in("lin-4.1")
screw = ef.CagedBallScrewWithMemory(design, reference_load=1000.0)
remembered = screw.run(nut_speed, 1000.0, angle).friction_torque
plain = ef.CagedBallScrew(design).run(nut_speed, 1000.0).friction_torque

figure, axis = plt.subplots(figsize=(7, 4.5))
axis.plot(1e3 * angle, plain, "C7", linewidth=0.6, label="by the speed alone")
axis.plot(1e3 * angle, remembered, "C0", linewidth=0.9, label="with memory")
axis.set(xlabel="nut angle (mrad)", ylabel="friction torque (N m)")
axis.legend()
figure.tight_layout()
figure.savefig(sys.argv[1] + "/hysteresis.svg")
