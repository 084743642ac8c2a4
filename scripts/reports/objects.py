# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""The measured numbers of each virtual object, and the paper's numbers.

Documentation: docs/figures.md, docs/scenes.md
"""

from dataclasses import dataclass

import numpy as np

from reports import measure
from reports.runs import design


@dataclass(frozen=True)
class View:
    """What is true of a run after arming, as arrays."""

    scene: str
    design: str
    column: str  # of the figure's table
    time: np.ndarray
    theta: np.ndarray
    omega: np.ndarray
    reference: np.ndarray
    motor: np.ndarray
    observed: np.ndarray
    ideal: np.ndarray

    @property
    def of_motion(self):
        """Whether the hand moves as the paper's."""
        return self.column.endswith("_motion")


def view(run, scene, column=None, arm_s=None):
    """`column`: the design's name where none is given; `arm_s`: that of the shipped scene."""
    csv = run.csv
    on = csv["time_s"] >= (measure.arm_time(scene) if arm_s is None else arm_s + measure.RAMPED_S)
    theta, omega = csv["theta_rad"][on], csv["omega_rad_s"][on]
    return View(
        scene,
        run.design,
        column or run.design,
        csv["time_s"][on],
        theta,
        omega,
        csv["tau_ref_nm"][on],
        csv["motor_torque_nm"][on],
        csv["tau_hat_nm"][on],
        measure.ideal_torque(scene, run.design, theta, omega),
    )


def adder(found, views):
    """add(key, number of a view): one row of the figure's table."""

    def add(key, of):
        values = {}
        for v in views:
            try:
                values[v.column] = of(v)
            except (TypeError, ValueError):
                continue  # no such rows in a run that went otherwise; its fault is told
        found.add(key, values)

    return add


def motion(found, views):
    """Rows on the paper's own motion."""
    add = adder(found, [v for v in views if v.of_motion])
    add("start_rad", lambda v: v.theta[0])
    add("begins_s", lambda v: v.time[np.argmax(np.abs(v.omega) > 0.01)])
    add("end_rad", lambda v: v.theta[-1])


def add_vibration(add, where):
    """Rows on the ripple of observed and motor torque while `where` holds without a break."""

    def rms_of(name):
        def of(v):
            part = where(v)
            first = int(np.argmax(part))
            after = part[first:]
            length = int(np.argmin(after)) if not after.all() else len(after)
            span = slice(first, first + length)
            return 1e3 * measure.rms(measure.ripple(v.time[span], getattr(v, name)[span]))

        return of

    add("observed_vibration_mnm", rms_of("observed"))
    add("motor_vibration_mnm", rms_of("motor"))


def inner(v, low, high):
    return (v.theta > low) & (v.theta < high)


def stiffness(v, part, values):
    """Of a spring, from the rows of this part."""
    return -measure.slope(v.theta[part(v)], values[part(v)])[0]


def membrane(found, views):
    add = adder(found, views)
    lower, upper = (design("lever")["scenes"][f"membrane_{e}_rad"] for e in ("lower", "upper"))

    def middle(v):
        return inner(v, lower + 0.05, upper - 0.05)

    add("torque_inside_nm", lambda v: v.motor[middle(v)].mean())
    add("reference_inside_nm", lambda v: v.reference[middle(v)].mean())
    add("upper_edge_rad", lambda v: v.theta[np.abs(v.reference) > 0.25].max())
    add("lower_edge_rad", lambda v: v.theta[np.abs(v.reference) > 0.25].min())
    add_vibration(add, middle)


def spring_compression(found, views):
    add = adder(found, views)

    def contact(v):
        return inner(v, 0.02, 0.48)

    add("stiffness_nm_rad", lambda v: stiffness(v, contact, v.reference))
    add("motor_stiffness_nm_rad", lambda v: stiffness(v, contact, v.motor))
    add("contact_rad", lambda v: v.theta[v.reference > 0.002].max())
    add("largest_torque_nm", lambda v: v.reference.max())
    add_vibration(add, contact)


def spring_tension(found, views):
    add = adder(found, views)

    def free(v):
        return inner(v, 0.05, 0.95)

    add("stiffness_nm_rad", lambda v: stiffness(v, free, v.reference))
    add("saturates_rad", lambda v: v.theta[v.reference <= -0.4999].min())
    add("largest_torque_nm", lambda v: v.reference.min())
    add_vibration(add, free)


def damper(found, views):
    add = adder(found, views)

    def damping(v):
        moving = np.abs(v.omega) > 0.2
        return -measure.slope(v.omega[moving], v.reference[moving])[0]

    add("largest_torque_nm", lambda v: np.abs(v.reference).max())
    add("largest_speed_rad_s", lambda v: np.abs(v.omega).max())
    add("damping_nm_s_rad", damping)
    add("delay_ms", lambda v: 1e3 * measure.lag_s(v.time, v.reference, v.ideal))
    add("expected_delay_ms", lambda v: expected_delay_ms(v.design))


def expected_delay_ms(design_name):
    velocity = design(design_name)["velocity"]
    tick = 1 / design(design_name)["clock"]["tick_hz"]
    return 1e3 * (0.5 * velocity["m1"] * tick + 1 / velocity["cutoff_rad_s"])


def charge(found, views, sign):
    add = adder(found, views)

    def far(v):
        return inner(v, 0.25, 1.4)

    def exponent(v):
        sizes = np.abs(v.reference[far(v)])
        good = sizes > 1e-3
        return measure.slope(np.log(v.theta[far(v)][good]), np.log(sizes[good]))[0]

    add("largest_torque_nm", lambda v: sign * (sign * v.reference).max())
    add("exponent", exponent)
    add("limit_rad", lambda v: v.theta[sign * v.reference >= 0.49].max())
    add("nearest_torque_nm", lambda v: v.reference[np.argmin(np.abs(v.theta - 0.05))])
    add_vibration(add, far)


def charge_attract(found, views):
    charge(found, views, -1)


def charge_repel(found, views):
    charge(found, views, +1)
    add = adder(found, [v for v in views if v.of_motion])
    add("torque_at_start_nm", lambda v: v.reference[0])
