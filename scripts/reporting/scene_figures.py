# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Figures 14, 16, 17, 19, 21 and 22 of the paper: virtual objects under a moving hand.

Documentation: docs/figures.md, docs/scenes.md
"""

from dataclasses import dataclass

import numpy as np

from reporting import measure, plots
from reporting.paper_figure import PaperFigure
from reporting.run_section import torque_constant
from reporting.runs import design, scene_job


@dataclass(frozen=True)
class View:
    """What is true of a run after arming, as arrays."""

    scene: str
    design: str
    time: np.ndarray
    theta: np.ndarray
    omega: np.ndarray
    reference: np.ndarray
    motor: np.ndarray
    observed: np.ndarray
    ideal: np.ndarray


def view(run, scene):
    csv = run.csv
    on = csv["time_s"] >= measure.arm_time(scene)
    theta, omega = csv["theta_rad"][on], csv["omega_rad_s"][on]
    return View(
        scene,
        run.design,
        csv["time_s"][on],
        theta,
        omega,
        csv["tau_ref_nm"][on],
        csv["motor_torque_nm"][on],
        csv["tau_hat_nm"][on],
        measure.ideal_torque(scene, run.design, theta, omega),
    )


def picture(number, run, scene, mirrored, png):
    csv, v = run.csv, view(run, scene)
    heights = [0.8, 1.4, 1.3] if scene != "damper" else [0.8, 0.8, 1.3, 1.2]
    figure, axes = plots.stacked(
        f"{scene.replace('_', ' ').capitalize()}, design {v.design}", heights
    )
    position, command, observed = axes[0], axes[-2], axes[-1]
    time, constant = csv["time_s"], torque_constant(v.design)
    plots.draw(position, time, csv["position_rad"], "rtl")
    plots.draw(position, time, csv["theta_rad"], "ideal", "lever")
    position.set_ylabel("position, rad")
    plots.legend(position)
    if scene == "damper":
        velocity = axes[1]
        plots.draw(velocity, time, csv["velocity_rad_s"], "rtl")
        plots.draw(velocity, time, csv["quad_velocity_rad_s"], "quad")
        plots.draw(velocity, time, csv["omega_rad_s"], "ideal", "lever")
        velocity.set_ylabel("velocity, rad/s")
        plots.legend(velocity)
    plots.draw(command, time, csv["motor_torque_nm"], "motor")
    plots.draw(command, time, constant * csv["current_a"], "rtl", "commanded, RTL")
    plots.draw(command, time, constant * csv["quad_current_a"], "quad", "quad")
    plots.draw(observed, time, csv["tau_hat_nm"], "rtl", "observed, RTL")
    plots.draw(observed, time, csv["quad_tau_hat_nm"], "quad", "quad")
    for axis in (command, observed):
        plots.draw(axis, v.time, v.ideal, "ideal")
        plots.legend(axis)
        if mirrored:
            axis.invert_yaxis()
    command.set_ylabel("torque, Nm" + (", mirrored" if mirrored else ""))
    observed.set_ylabel("observed, Nm" + (", mirrored" if mirrored else ""))
    axes[-1].set_xlabel("time, s")
    figure.align_ylabels(axes)
    return plots.finish(figure, f"figure-{number}-{v.design}", png=png)


def by(views, function):
    """{design: number}."""
    return {v.design: function(v) for v in views}


def vibration_mnm(v, where):
    """Rms of motor torque less ideal, without its mean."""
    difference = (v.motor - v.ideal)[where(v)]
    return 1e3 * measure.rms(difference - difference.mean()) if len(difference) else None


def inner(v, low, high):
    return (v.theta > low) & (v.theta < high)


def membrane(found, views):
    lower, upper = (design("lever")["scenes"][f"membrane_{e}_rad"] for e in ("lower", "upper"))

    def middle(v):
        return inner(v, lower + 0.05, upper - 0.05)

    found.add(
        "torque_inside_nm",
        "motor torque inside, mean, Nm",
        "−0.5 (its sign)",
        **by(views, lambda v: v.motor[middle(v)].mean()),
    )
    found.add(
        "reference_inside_nm",
        "torque reference inside, Nm",
        "−0.5 (its sign)",
        **by(views, lambda v: v.reference[middle(v)].mean()),
    )
    found.add(
        "upper_edge_rad",
        "edge where it begins, rad",
        "0.7",
        **by(views, lambda v: v.theta[np.abs(v.reference) > 0.25].max()),
    )
    found.add(
        "lower_edge_rad",
        "edge where it ends, rad",
        "0.5",
        **by(views, lambda v: v.theta[np.abs(v.reference) > 0.25].min()),
    )
    found.add(
        "vibration_mnm",
        "vibration of the motor torque inside, rms, mNm",
        "",
        **by(views, lambda v: vibration_mnm(v, middle)),
    )
    found.notes.append(
        "The axis is mirrored: the paper's torque is −0.5 Nm while the lever moves from 4.5 rad "
        "towards 0; ours is positive in the direction that counts up, so the same push is +0.5."
    )


def spring_compression(found, views):
    def contact(v):
        return inner(v, 0.02, 0.48)

    found.add(
        "stiffness_nm_rad",
        "stiffness of the reference, Nm/rad",
        "linear from 0.5 rad to 0",
        **by(views, lambda v: -measure.slope(v.theta[contact(v)], v.reference[contact(v)])[0]),
    )
    found.add(
        "motor_stiffness_nm_rad",
        "stiffness of the motor torque, Nm/rad",
        "",
        **by(views, lambda v: -measure.slope(v.theta[contact(v)], v.motor[contact(v)])[0]),
    )
    found.add(
        "contact_rad",
        "contact, rad",
        "0.5",
        **by(views, lambda v: v.theta[v.reference > 0.002].max()),
    )
    found.add(
        "largest_torque_nm",
        "largest reference, Nm",
        "“the maximum force”, at 0 rad",
        **by(views, lambda v: v.reference.max()),
    )
    found.add(
        "vibration_mnm",
        "motor torque less ideal in contact, rms about its mean, mNm",
        "“a small vibration”",
        **by(views, lambda v: vibration_mnm(v, contact)),
    )
    found.notes.append(
        "The paper does not give the stiffness; 0.5 Nm at 0 rad makes it 1 Nm/rad. In design "
        "paper the motor's torque falls where the reference passes 0.15 Nm (figure 10): a step that the hand "
        "feels in the middle of a linear spring."
    )


def spring_tension(found, views):
    def free(v):
        return inner(v, 0.05, 0.95)

    found.add(
        "stiffness_nm_rad",
        "stiffness of the reference, Nm/rad",
        "0.5 (0.5 Nm at 1 rad)",
        **by(views, lambda v: -measure.slope(v.theta[free(v)], v.reference[free(v)])[0]),
    )
    found.add(
        "saturates_rad",
        "angle at which the torque reaches its limit, rad",
        "1",
        **by(views, lambda v: v.theta[v.reference <= v.reference.min() + 1e-4].min()),
    )
    found.add(
        "largest_torque_nm",
        "largest reference, Nm",
        "0.5 in size",
        **by(views, lambda v: v.reference.min()),
    )
    found.add(
        "vibration_mnm",
        "motor torque less ideal, rms about its mean, mNm",
        "“not perceptible”",
        **by(views, lambda v: vibration_mnm(v, free)),
    )
    found.notes.append(
        "The paper pulls to about 3 rad, we to 1.6 rad: beyond 1 rad nothing changes. The torque "
        "draws the lever back, so here it is negative; the paper's text gives its size only."
    )


def damper(found, views):
    def moving(v):
        return np.abs(v.omega) > 0.2

    found.add(
        "largest_torque_nm",
        "largest reference in size, Nm",
        "0.13",
        **by(views, lambda v: np.abs(v.reference).max()),
    )
    found.add(
        "largest_speed_rad_s",
        "largest speed of the lever, rad/s",
        "",
        **by(views, lambda v: np.abs(v.omega).max()),
    )
    found.add(
        "damping_nm_s_rad",
        "reference over velocity, slope, Nm s/rad",
        "not given",
        **by(views, lambda v: -measure.slope(v.omega[moving(v)], v.reference[moving(v)])[0]),
    )
    found.add(
        "delay_ms",
        "delay of the reference behind the velocity, ms",
        "",
        **by(views, lambda v: 1e3 * measure.lag_s(v.time, v.reference, v.ideal)),
    )
    found.add(
        "expected_delay_ms",
        "the same from m1 and the low-pass, ms",
        "",
        **by(views, lambda v: expected_delay_ms(v.design)),
    )
    found.notes.append(
        "The paper gives neither damping nor speed; 0.03 Nm s/rad is ours, and so is the motion "
        "(0.15 rad in 80 ms; the paper's about 0.1 rad). Only the shape can be compared: the torque "
        "follows the velocity and opposes it. The estimated velocity is late, and the slope is "
        "taken against the true one, so it is a little below 0.03."
    )


def expected_delay_ms(design_name):
    velocity = design(design_name)["velocity"]
    tick = 1 / design(design_name)["clock"]["tick_hz"]
    return 1e3 * (0.5 * velocity["m1"] * tick + 1 / velocity["cutoff_rad_s"])


def charge(found, views, sign):
    def far(v):
        return inner(v, 0.25, 1.4)

    def exponent(v):
        sizes = np.abs(v.reference[far(v)])
        good = sizes > 1e-3
        return measure.slope(np.log(v.theta[far(v)][good]), np.log(sizes[good]))[0]

    found.add(
        "largest_torque_nm",
        "largest reference, Nm",
        "+0.5 (its sign)" if sign < 0 else "−0.5 (its sign)",
        **by(views, lambda v: sign * (sign * v.reference).max()),
    )
    found.add(
        "exponent",
        "exponent of the distance, fitted from 0.25 to 1.4 rad",
        "−2 by its equation; “exponential” in its words",
        **by(views, exponent),
    )
    found.add(
        "limit_rad",
        "distance at which the limit is reached, rad",
        "",
        **by(views, lambda v: v.theta[sign * v.reference >= 0.499].max()),
    )
    found.add(
        "nearest_torque_nm",
        "reference at 0.05 rad, Nm",
        "",
        **by(views, lambda v: v.reference[np.argmin(np.abs(v.theta - 0.05))]),
    )
    found.notes += [
        "The axis is mirrored: the paper counts attraction as positive and repulsion as negative; "
        "ours is positive in the direction that counts up.",
        "The paper gives no charge; 0.02 Nm rad² is ours and reaches the limit at 0.2 rad. Nearer, "
        "design paper stays at the limit with its raw 1/x², while lever falls to 0 along a line, so that "
        "the pole has a slope a sampled encoder can bear.",
    ]


def attract(found, views):
    charge(found, views, -1)
    found.notes.append("The paper moves from 4.5 rad to 0, we from 1.5 to 0.05 rad.")


def repel(found, views):
    charge(found, views, +1)
    found.notes.append(
        "The paper starts at 0 and moves away; we come from 1.5 rad and end at 0.05."
    )


@dataclass(frozen=True)
class Spec:
    number: int
    scene: str
    title: str
    said: str
    fill: object
    mirrored: bool = False


SPECS = (
    Spec(
        14,
        "membrane",
        "virtual membrane",
        "between 0.7 and 0.5 rad the torque is constant, −0.5 Nm; outside it is 0.",
        membrane,
        True,
    ),
    Spec(
        16,
        "spring_compression",
        "compression spring",
        "touched at 0.5 rad, fully compressed at 0, where the force is greatest; a small vibration "
        "in the zoom, perhaps from the experimental setup.",
        spring_compression,
    ),
    Spec(
        17,
        "spring_tension",
        "tension spring",
        "pulled from 0 to about 3 rad; the torque reaches its limit of 0.5 Nm at 1 rad; a small "
        "vibration, not perceptible.",
        spring_tension,
    ),
    Spec(
        19,
        "damper",
        "viscous damper",
        "moved fast from 0 to about 0.1 rad; the torque rises to 0.13 Nm in proportion to the "
        "velocity.",
        damper,
    ),
    Spec(
        21,
        "charge_attract",
        "attracting charges",
        "from 4.5 rad towards 0 the torque grows “exponentially in a positive direction”.",
        attract,
        True,
    ),
    Spec(
        22,
        "charge_repel",
        "repelling charges",
        "from −0.5 Nm at 0 rad the torque decreases “exponentially in magnitude” as the lever "
        "moves away; vibrations small enough for the classroom.",
        repel,
        True,
    ),
)


def jobs(designs):
    return [scene_job(spec.scene, d, every=50) for spec in SPECS for d in designs]


def figure(spec, runs, designs, png=False):
    found = PaperFigure(spec.number, spec.title, spec.said, [(d, d) for d in designs])
    there = [runs[n] for d in designs if (n := scene_job(spec.scene, d).name) in runs]
    found.pictures = [picture(spec.number, run, spec.scene, spec.mirrored, png) for run in there]
    views = [view(run, spec.scene) for run in there]
    spec.fill(found, views)
    for name, key in (("tau_hat_nm", "observed torque"), ("torque_nm", "commanded torque")):
        errors = {
            r.design: 1e6 * e["max_error"]
            for r in there
            if (e := r.summary["engines"].get("rtl", {}).get(name))
        }
        stem = name.removesuffix("_nm")
        found.add(f"{stem}_max_error_unm", f"{key}, RTL less quad, largest, µNm", "", **errors)
    return found
