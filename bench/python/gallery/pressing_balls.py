"""Friction of 37 balls that press on each other over two turns of the nut, in the loop and exactly (Lin 2019, Figure 3.25)."""

import math
import sys

import matplotlib.pyplot as plt

import epas_friction as ef

design = ef.Design.built_in("lin-3.6")
time, nut_speed, axial_load = ef.manoeuvre("turns", design)
run = ef.simulate_uncaged(design, time, nut_speed, axial_load)
# The exact screw solves every state anew, so at fewer places; its balls go from one to the next.
few = slice(None, None, 8)
exact = ef.reference.simulate_uncaged(design, time[few], nut_speed[few], axial_load[few])

angle = time * nut_speed * 180.0 / math.pi
figure, (torque, pressing) = plt.subplots(2, 1, figsize=(8, 6), sharex=True)
torque.plot(angle, run.friction_torque, label="in the loop, float32")
torque.plot(angle, run.groove_torque, label="its part from the grooves")
torque.plot(angle[few], exact.friction_torque, "k.", markersize=2.5, label="exact, float64")
torque.set_ylabel("friction torque (N m)")
torque.legend()
pressing.plot(angle, run.largest_contact_force, "C3")
pressing.set(xlabel="nut angle (degrees)", ylabel="largest force\nbetween balls (N)")
contacts = pressing.twinx()
contacts.step(angle, run.contacts, "C7", linewidth=0.7)
contacts.set_ylabel("pairs of balls that press")
figure.tight_layout()
figure.savefig(sys.argv[1] + "/pressing_balls.svg")
