# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""The measured numbers of each virtual object, and the paper's numbers.

Documentation: docs/figures.md, docs/scenes.md
"""

from dataclasses import dataclass

import numpy as np

from reporting import measure
from reporting.runs import design


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
    """add(key, what, published, number of a view): one row of the figure's table."""

    def add(key, what, published, of):
        values = {}
        for v in views:
            try:
                values[v.column] = of(v)
            except (TypeError, ValueError):
                continue  # no such rows in a run that went otherwise; its fault is told
        found.add(key, what, published, **values)

    return add


def motion(found, views, paper):
    """Rows on the paper's own motion; `paper` has its words."""
    add = adder(found, [v for v in views if v.of_motion])
    add("start_rad", "its motion starts at, rad", paper.start, lambda v: v.theta[0])
    add(
        "begins_s",
        "and moves from, s",
        paper.begins,
        lambda v: v.time[np.argmax(np.abs(v.omega) > 0.01)],
    )
    add("end_rad", "and ends at, rad", paper.end, lambda v: v.theta[-1])


def add_vibration(add, where, published=""):
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

    add(
        "observed_vibration_mnm",
        "vibration of the observed torque, rms, mNm",
        published,
        rms_of("observed"),
    )
    add(
        "motor_vibration_mnm", "vibration of the motor torque, rms, mNm", published, rms_of("motor")
    )


def inner(v, low, high):
    return (v.theta > low) & (v.theta < high)


def membrane(found, views):
    add = adder(found, views)
    lower, upper = (design("lever")["scenes"][f"membrane_{e}_rad"] for e in ("lower", "upper"))

    def middle(v):
        return inner(v, lower + 0.05, upper - 0.05)

    add(
        "torque_inside_nm",
        "motor torque inside, mean, Nm",
        "−0.5 (its sign)",
        lambda v: v.motor[middle(v)].mean(),
    )
    add(
        "reference_inside_nm",
        "torque reference inside, Nm",
        "−0.5 (its sign)",
        lambda v: v.reference[middle(v)].mean(),
    )
    add(
        "upper_edge_rad",
        "edge where it begins, rad",
        "0.7",
        lambda v: v.theta[np.abs(v.reference) > 0.25].max(),
    )
    add(
        "lower_edge_rad",
        "edge where it ends, rad",
        "0.5",
        lambda v: v.theta[np.abs(v.reference) > 0.25].min(),
    )
    add_vibration(add, middle)
    found.notes.append(
        "The axis is mirrored: the paper's torque is −0.5 Nm while the lever moves from 4.5 rad "
        "towards 0; ours is positive in the direction that counts up, so the same push is +0.5."
    )


# Which speed a hand happens to have decides what the N-method makes of its counts.
STEADY = (
    "Our own motion has the one speed at which design lever is most quiet: at 2 rad/s exactly one "
    "count falls into every m1 ticks. At the speed chosen for the paper's motion one or two do."
)


def spring_compression(found, views):
    add = adder(found, views)

    def contact(v):
        return inner(v, 0.02, 0.48)

    add(
        "stiffness_nm_rad",
        "stiffness of the reference, Nm/rad",
        "linear from 0.5 rad to 0",
        lambda v: -measure.slope(v.theta[contact(v)], v.reference[contact(v)])[0],
    )
    add(
        "motor_stiffness_nm_rad",
        "stiffness of the motor torque, Nm/rad",
        "",
        lambda v: -measure.slope(v.theta[contact(v)], v.motor[contact(v)])[0],
    )
    add("contact_rad", "contact, rad", "0.5", lambda v: v.theta[v.reference > 0.002].max())
    add(
        "largest_torque_nm",
        "largest reference, Nm",
        "“the maximum force”, at 0 rad",
        lambda v: v.reference.max(),
    )
    add_vibration(add, contact, "“a small vibration”")
    found.notes.append(
        "The paper does not give the stiffness; 0.5 Nm at 0 rad makes it 1 Nm/rad. In design "
        "paper the motor's torque falls where the reference passes 0.15 Nm (figure 10): a "
        "step that the hand feels in the middle of a linear spring."
    )
    found.notes.append(STEADY)


def spring_tension(found, views):
    add = adder(found, views)

    def free(v):
        return inner(v, 0.05, 0.95)

    add(
        "stiffness_nm_rad",
        "stiffness of the reference, Nm/rad",
        "0.5 (0.5 Nm at 1 rad)",
        lambda v: -measure.slope(v.theta[free(v)], v.reference[free(v)])[0],
    )
    add(
        "saturates_rad",
        "angle at which the torque reaches its limit, rad",
        "1",
        lambda v: v.theta[v.reference <= -0.4999].min(),
    )
    add("largest_torque_nm", "largest reference, Nm", "0.5 in size", lambda v: v.reference.min())
    add_vibration(add, free, "“not perceptible”")
    found.notes.append(
        "Our own motion ends at 1.6 rad: beyond 1 rad nothing changes. Held at 0.5 Nm for longer "
        "than 1.1 s, soon after power-up, the core trips: 16.6 A are three times the motor's "
        "nominal current, and the paper tells of no limit in time. The torque "
        "draws the lever back, so here it is negative; the paper's text gives its size only. The "
        "vibration of the observed torque in design paper is one pulse per encoder count, seen "
        "through an inertia four times too large; the motor gets a fifth of it."
    )
    found.notes.append(STEADY)


def damper(found, views):
    add = adder(found, views)

    def moving(v):
        return np.abs(v.omega) > 0.2

    add(
        "largest_torque_nm",
        "largest reference in size, Nm",
        "0.13",
        lambda v: np.abs(v.reference).max(),
    )
    add(
        "largest_speed_rad_s",
        "largest speed of the lever, rad/s",
        "",
        lambda v: np.abs(v.omega).max(),
    )
    add(
        "damping_nm_s_rad",
        "reference over velocity, slope, Nm s/rad",
        "not given",
        lambda v: -measure.slope(v.omega[moving(v)], v.reference[moving(v)])[0],
    )
    add(
        "delay_ms",
        "delay of the reference behind the velocity, ms",
        "",
        lambda v: 1e3 * measure.lag_s(v.time, v.reference, v.ideal),
    )
    add(
        "expected_delay_ms",
        "the same from m1 and the low-pass, ms",
        "",
        lambda v: expected_delay_ms(v.design),
    )
    found.notes.append(
        "The paper gives neither damping nor speed; 0.03 Nm s/rad is ours. Its 0.13 Nm and 0.1 rad "
        "fix only the damping by the duration, 0.69 Nm s/rad per second of a smooth motion: 42.5 "
        "ms with ours, and ten times that with 0.3 Nm s/rad. Only the shape can be compared: the "
        "torque follows the velocity and opposes it. The slope is taken against the true velocity, "
        "and the estimated one comes late."
    )


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

    add(
        "largest_torque_nm",
        "largest reference, Nm",
        "+0.5 (its sign)" if sign < 0 else "−0.5 (its sign)",
        lambda v: sign * (sign * v.reference).max(),
    )
    add(
        "exponent",
        "exponent of the distance, fitted from 0.25 to 1.4 rad",
        "−2 by its equation; “exponential” in its words",
        exponent,
    )
    add(
        "limit_rad",
        "distance at which 0.49 Nm are reached, rad",
        "",
        lambda v: v.theta[sign * v.reference >= 0.49].max(),
    )
    add(
        "nearest_torque_nm",
        "reference at 0.05 rad, Nm",
        "",
        lambda v: v.reference[np.argmin(np.abs(v.theta - 0.05))],
    )
    add_vibration(add, far, "“small” (figure 22)" if sign > 0 else "")
    found.notes += [
        "The axis is mirrored: the paper counts attraction as positive and repulsion as negative; "
        "ours is positive in the direction that counts up.",
        "The paper gives no charge; 0.02 Nm rad² is ours and reaches the limit at 0.2 rad. Nearer, "
        "design paper stays at the limit with its raw 1/x², while lever falls to 0 along a line, "
        "a slope that a sampled encoder can bear.",
    ]


def attract(found, views):
    charge(found, views, -1)
    found.notes.append(
        "At 4.5 rad the torque is 1 mNm, a quarter of the friction: most of the paper's motion is "
        "felt as nothing. At 0 itself design paper stays at its limit, lever is at rest."
    )


def repel(found, views):
    charge(found, views, +1)
    adder(found, [v for v in views if v.of_motion])(
        "torque_at_start_nm",
        "reference at 0 rad, at rest, Nm",
        "−0.5 (its sign)",
        lambda v: v.reference[0],
    )
    found.notes.append(
        "On the charge itself its equation has no direction. Design paper pushes upwards there, by "
        "a sign that is defined; lever starts with nothing, and meets its largest torque at 0.2 "
        "rad. Our own motion comes from 1.5 rad instead. With 0.5 Nm from the beginning of the "
        "recording design paper would trip at 1.2 s, to save the motor."
    )
