"""Friction of 37 balls that press on each other over two turns of the nut, in the loop and exactly (Lin 2019, Figure 3.25)."""

import sys

import matplotlib.pyplot as plt
import numpy as np

import epas_friction as ef

design = ef.Design.built_in("lin-3.6")
time, nut_speed, axial_load = ef.manoeuvre("turns", design)
run = ef.simulate_uncaged(design, time, nut_speed, axial_load)
# The exact screw solves every state anew: some 40 places are enough for the eye.
few = np.linspace(0, len(time) - 1, 41).astype(int)
exact = ef.reference.simulate_uncaged(design, time[few], nut_speed[few], axial_load[few])

angle = np.degrees(time * nut_speed)
figure, (torque, pressing) = plt.subplots(2, 1, figsize=(8, 6), sharex=True)
torque.plot(angle, run.friction_torque, label="in the loop, float32")
torque.plot(angle, run.groove_torque, label="its part from the grooves")
torque.plot(angle[few], exact.friction_torque, "k.", label="exact, float64")
torque.set_ylabel("friction torque (N m)")
torque.legend()
pressing.plot(angle, run.largest_contact_force, "C3")
pressing.set(xlabel="nut angle (degrees)", ylabel="largest force\nbetween balls (N)")
contacts = pressing.twinx()
contacts.step(angle, run.contacts, "C7", linewidth=0.7)
contacts.set_ylabel("pairs of balls that press")
figure.tight_layout()
figure.savefig(sys.argv[1] + "/pressing_balls.svg")
