"""Error of the groove curvature over the lead: the formula of the literature, a circular groove, the fit of the control interrupt."""

import sys

import matplotlib.pyplot as plt
import numpy as np

import epas_friction as ef

PITCH_RADIUS, BALL_RADIUS, CONFORMITY, CONTACT_ANGLE = 16.5e-3, 2.778e-3, 0.56, np.pi / 4

lead = np.linspace(1e-3, 60e-3, 400)
lead_angle = np.arctan(lead / (2.0 * np.pi * PITCH_RADIUS))
groove_radius = 2.0 * CONFORMITY * BALL_RADIUS
offset = (groove_radius - BALL_RADIUS) * np.sqrt(0.5)
section = (PITCH_RADIUS, lead_angle, CONTACT_ANGLE, groove_radius)

figure, axes = plt.subplots(1, 2, figsize=(9, 4), sharey=True)
for axis, groove in zip(axes, ["screw", "nut"]):
    exact = ef.reference.groove_curvature(groove, *section, offset, offset).kappa1
    for name, kappa1 in [
        ("literature", ef.literature_curvature(groove, PITCH_RADIUS, CONTACT_ANGLE, BALL_RADIUS)),
        ("circular groove", ef.circular_groove_curvature(groove, *section)),
        ("fit in the loop", ef.fitted_curvature(groove, *section, offset, offset)),
        ("exact, float32", ef.groove_curvature(groove, *section, offset, offset).kappa1),
    ]:
        axis.semilogy(1e3 * lead, np.abs(kappa1 / exact - 1.0) + 1e-9, label=name)
    axis.set(title=groove, xlabel="lead (mm)")
axes[0].set_ylabel("relative error of the first curvature")
axes[0].legend()
figure.tight_layout()
figure.savefig(sys.argv[1] + "/curvature_error.svg")
