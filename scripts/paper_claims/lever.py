# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Claims of the Haptic Lever: for each a function, as claims.py says. Documentation: docs/claims.md"""
import math

import numpy as np

from paper_claims.simulations import COUNT, TICK, flow, largest, run, scene, settled, turned

# The paper's numbers, and those of the motor with the 24 V winding: vectors/plants/p24.toml
M1, CUTOFF, KTN, JN, KP, LIMIT, SOURCE_A = 386, 500, 0.0605, 4.896e-4, 1600, 0.5, 7
KT, OHM, BRUSH, SUPPLY, COULOMB, J = 0.0302, 0.42, 0.34, 24, 3.5e-3, 1.22e-4


def error_pct(kv, tau):
    """The motor's torque (V - brushes) Kt / R for V = Kv tau / Ktn, against tau."""
    return 100 * ((kv * tau / KTN - BRUSH) * KT / OHM / tau - 1)


def dob_settling():
    """claim: the torque responds in approximately 10 ms
    where: Lever, III.C.2, Fig. 11, Table 4
    closed_form: At a locked shaft the loop has the pole g Jn Kp; ln 50 over it is the time to 2 %
    simulation: `torque_step`, design `paper`, steps to 0.1, 0.2 and 0.3 Nm
    why: the torque is the observed one. The motor's own torque is there earlier, and by another amount (`kv_error`)
    gives: pole | rad/s; observed torque settles | ms | if near 10 ± 0.5; motor torque settles | ms"""
    found, pole = run("torque_step", "paper")[0], CUTOFF * JN * KP
    slowest, motor = (max(found[f"{of}_settling_ms.{i}"] for i in range(3)) for of in ("tau_hat", "torque"))
    return (pole, 1e3 * math.log(50) / slowest), (1e3 * math.log(50) / pole, slowest), (None, motor)


def inertia():
    """claim: J = Tm Kt Ke / Rn = 0.0004896 kg m²
    where: Lever, III.C, eq. 6, Table 3
    closed_form: With Tm = 40 ms, Kt = Ke = 0.0605 and Rn = 0.30 ohm, of which the paper gives Kt alone
    simulation: current and speed of a free motor at 1 V, exactly: time to 63 % of its speed, with Table 3, and with the
      data sheet's Kt and the J that follows
    why: Tm is 40 ms, Rn 0.30 ohm and Kt 0.0605. Kt is twice the data sheet's of the 24 V winding, so J is four times as
      large: one error, not two. The time constant is the same with both; the speed per volt tells them apart
    gives: J | kg m² | if near 4.896e-4 ± 2.448e-6; J with Kt = 0.0302 | kg m²; time constant, Table 3 | ms; time
      constant, data sheet | ms; speed per volt, Table 3 | rad/s; speed per volt, data sheet | rad/s"""
    def free(kt, j, henry=82.3e-6):  # L i' = 1 V - R i - Ke w, J w' = Kt i; the third state is the volt
        rate = np.array([[-0.30 / henry, -kt / henry, 1 / henry], [kt / j, 0, 0], [0, 0, 0]])
        speed = lambda seconds: (flow(rate, seconds) @ [0, 0, 1])[1]
        return 1e3 * largest(lambda t: speed(t) < (1 - math.exp(-1)) / kt, 1e-3), speed(0.4)
    table, sheet = free(KTN, JN), free(KT, J)
    return 0.040 * KTN**2 / 0.30, 0.040 * KT**2 / 0.30, (1e3 * JN * 0.30 / KTN**2, table[0]), \
        (1e3 * J * 0.30 / KT**2, sheet[0]), (1 / KTN, table[1]), (1 / KT, sheet[1])


def window():
    """claim: m1 Tp should be around 100 µs (m1 = 386, Tp = 1 µs)
    where: Lever, III.B, Table 2
    closed_form: The product; a count in this window is 2 pi / (Er m1 Tp)
    simulation: `paper`, a lever turned by one count: the low-pass rises for the length of the window
    why: its own m1 makes 386 µs. A window of 100 µs would be four times as noisy
    gives: m1 Tp | µs | near 100 ± 20; a count | rad/s; a count in 100 µs | rad/s; a count's peak behind the low-pass |
      rad/s"""
    rows = turned(1.5 * COUNT, 1e-5, "paper", 1)
    velocity, first = rows["velocity_rad_s"], rows["time_s"][np.nonzero(rows["velocity_rad_s"])[0][0]]
    peak_us = 1e6 * (rows["time_s"][velocity.argmax()] - first + TICK)
    return (1e6 * M1 * TICK, peak_us), COUNT / (M1 * TICK), COUNT / 100e-6, \
        (4 * (1 - math.exp(-CUTOFF * M1 * TICK)), velocity.max())


def evenly(design):
    """Velocity that a design finds at 10 rad/s, from 0.05 s on."""
    return settled(turned(5.0, 0.5, design, 7), "velocity_rad_s", 0.05)


def velocity_gain():
    """claim: 2^n takes the place of the factor, by the encoder's resolution
    where: Lever, III.B, eq. 2, Table 2
    closed_form: 2^n m1 Tp Er / (2 pi) - 1
    simulation: `paper` (m1 = 386, n = 2) and `lever` (m1 = 767, n = 1), a hand at 10 rad/s, mean of 0.45 s
    why: m1 is 767 and n is 1. With the paper's m1 every velocity is 0.65 % too large
    gives: gain error, m1 = 386, n = 2 | % | near 0 ± 0.02; m1 = 767, n = 1 | % | if near 0 ± 0.02"""
    def error(n, m1, design):
        return 100 * (2**n * m1 * TICK / COUNT - 1), 100 * (evenly(design).mean() / 10 - 1)
    return error(2, M1, "paper"), error(1, 767, "lever")


def n_method():
    """claim: the many velocities of the N-method in a sampling time of the M-method increase the accuracy
    where: Lever, III.B, Nandayapa et al. [64]
    closed_form: A count makes q / T in both methods. Behind the low-pass, a raw signal that is q / T too high for a
      share d of the time, f = w / q times a second, ripples by q / T g d (1 - d) / f, as rms over sqrt(12)
    simulation: `paper` at 10 rad/s, and the M-method with the same window and filter in real numbers, a value every 386
      µs
    why: it is the ripple behind the filter, at speed: the M-method's errors come 2591 times a second and beat, the
      N-method's with each count, 6519 times a second. What a count makes is the same; a window of 1 µs would make 1534
      rad/s
    gives: a count, both methods | rad/s; a count in a window of 1 µs | rad/s; ripple of the N-method, rms | rad/s; of
      the M-method | rad/s; resolution, N over M | | at most 0.5; ripple behind the low-pass, N over M | | if at most
      0.5"""
    quantum, d = COUNT / (M1 * TICK), 10 * M1 * TICK / COUNT % 1
    n_rms = quantum * CUTOFF * d * (1 - d) / (10 / COUNT) / math.sqrt(12)
    raw = np.diff(np.floor(10 * M1 * TICK / COUNT * np.arange(5000))) * quantum
    keep, values = math.exp(-CUTOFF * M1 * TICK), [10.0]
    for x in raw:  # held for 386 us, behind the same low-pass
        values.append(x + keep * (values[-1] - x))
    return quantum, COUNT / TICK, (n_rms, evenly("paper").std()), (None, np.std(values[100:])), 1, \
        (None, evenly("paper").std() / np.std(values[100:]))


def cutoff_equal():
    """claim: velocity and observer should have the same cut-off frequency
    where: Lever, III.B
    closed_form: Of a step of the torque on a free lever, the observer takes up to r^(-r/(r-1)) for a load, r = wc/g,
      the peak of g s / ((s + g)(s + r g)) on a step; the counts' ripple grows with wc
    simulation: `lever`, wc/g = 0.25, 0.5, 1, 2, 4, g = 120 rad/s: a free lever on plant `linear` without back-EMF, and
      1 rad/s on `p24`
    why: the false load falls and the ripple grows with wc, all the way: 1 is a compromise like any other
    gives: wc/g with the least false load | | near 1 ± 0; wc/g with the least ripple | | near 1 ± 0; false load at wc =
      g, share of the step"""
    g, ratios = 120, (0.25, 0.5, 1, 2, 4)  # so that 4 g fits the register
    step = scene("setpoint", 0.07, "free", arm_s=0.002, more="[[event]]\nat_s = 0.01\nset.setpoint_torque = 0.1\n[effects]\n"
                 "back_emf = false\n[parameters]\nemf_constant = 0\ndead_voltage = 0\ndead_voltage_slope = 0")
    formula, load, ripple = {}, {}, {}
    for r in ratios:
        a1 = -math.expm1(-r * g * TICK), -math.expm1(-g * TICK)
        filters = ("velocity_a1", a1[0]), ("observer_a1", a1[1]), ("inertia_gain", g * J)
        found = run(step, plant="linear", given=filters)[0]
        load[r] = 10 * max(found["tau_hat_max_nm"], -found["tau_hat_min_nm"])
        ripple[r] = settled(turned(0.4, 0.4, "lever", 50, filters), "tau_hat_nm", 0.1).std()
        formula[r] = math.exp(-1) if r == 1 else r ** (-r / (r - 1))
    return (min(ratios, key=formula.get), min(ratios, key=load.get)), (ratios[0], min(ratios, key=ripple.get)), \
        (formula[1], load[1])


def alternative_to_pid():
    """claim: the DOB is a good alternative to PID-based controllers
    where: Lever, IV.E
    closed_form: No baseline is given. At rest the observer gets the current that was asked for, so it sees its own
      command: the torque changes with 1/R and Kt, but the observed torque does not
    simulation: `torque_step` to 0.2 Nm, `paper`, plant `p24` with another R and Kt
    why: R and Kt stay those of the calibration, near 0.2 Nm. An integrator on a measured current would take that of R
      away, and leave that of Kt. PI and PID on the estimate take none: [controllers](controllers.md)
    gives: torque, R +20 % | % | near 0 ± 2; torque, Kt -50 % | % | near 0 ± 2; observed torque, R +20 % | %; torque at
      0.2 Nm, calibrated | % | if near 0 ± 2"""
    usual, warm, weak = (run("torque_step", "paper", constants=c)[0] for c in
                         ((), (("resistance_ohm", 1.2 * OHM),), (("torque_constant_nm_a", KT / 2),)))
    def change(found, of):
        return 100 * (found[f"{of}_final_nm.1"] / usual[f"{of}_final_nm.1"] - 1)
    return (100 * (1 / 1.2 - 1), change(warm, "torque")), (-50, change(weak, "torque")), (0, change(warm, "tau_hat")), \
        (error_pct(0.95, 0.2), usual["final_error_pct.1"])


def held(limit_a, radius_m=0.1, limited="true"):
    """A lever held where the spring is at its limit, on a source of so many amperes: rows from 1.1 s, largest over 1 ms."""
    text = scene("spring_tension", 1.2, "prescribed", ("hold", 0.2), ("minimum_jerk", 0.8, 1.6),
                 more=f"[effects]\nsupply_limit = {limited}\n[hand]\nradius_m = {radius_m}")
    _, felt, rows = run(text, constants=(("current_limit_a", float(limit_a)),), every=37)
    return {name: abs(settled(rows, name, 1.1)).mean() for name in rows}, abs(felt["torque"]["motor"]["peak_nm"])


def half_nm_of_7_a():
    """claim: ±0.5 Nm due to the 7 A that the power source can deliver
    where: Lever, III.A, III.C.2
    closed_form: 7 A times 0.0605; the 24 V winding needs 0.5 / 0.0302 A at R I + 0.34 V, and a bridge takes V I / 24 V
      from the source; a source of 4 A is taken at the voltage of 0.5 Nm
    simulation: `spring_tension`, held at its limit, `lever` with `supply_limit = true`: mean of 0.1 s; the source's
      current is the motor's times the duty without the dead time, 2.5 % of a period
    why: the 7 A are the source's. In the motor they would be 0.42 Nm. So the limit of the supply never acts in
      `spring_tension`, and the torque is 0.5 Nm with it and without; a source of 4 A shows it at work
    gives: torque of 7 A in the motor | Nm | near 0.5 ± 0.005; torque from a source of 7 A | Nm | if near 0.5 ± 0.005;
      largest over 1 ms, supply limited | Nm; largest over 1 ms, not limited | Nm; motor current | A; current from the
      source | A; torque from a source of 4 A | Nm"""
    amperes, volt, (seven, most) = LIMIT / KT, OHM * LIMIT / KT + BRUSH, held(SOURCE_A)
    torque, found_a = seven["motor_torque_nm"], seven["motor_torque_nm"] / KT
    return SOURCE_A * KTN, (LIMIT, torque), (None, most), (None, held(SOURCE_A, limited="false")[1]), \
        (amperes, found_a), (amperes * volt / SUPPLY, (seven["duty"] - 0.025) * found_a), \
        (KT * 4 * SUPPLY / volt, held(4)[0]["motor_torque_nm"])


def forces():
    """claim: forces of up to 0.5 Nm at one lever: r = 0.1 m, r = 0.2 m
    where: Lever, IV.B, eq. 9; IV.D, eq. 14
    closed_form: 0.5 Nm / r
    simulation: `spring_tension`, held at its limit, the hand at 0.1 and at 0.2 m
    why: springs and membrane are felt at 0.1 m and charges at 0.2 m, where the largest force is half as large. The
      calibration was made at 0.011 m
    gives: largest force at 0.2 m over that at 0.1 m | | near 1 ± 0.02; at 0.1 m | N | if near 5 ± 0.1; at 0.2 m | N |
      if near 2.5 ± 0.05"""
    close, far = held(SOURCE_A)[0]["hand_torque_nm"] / 0.1, held(SOURCE_A, 0.2)[0]["hand_torque_nm"] / 0.2
    return (0.5, far / close), (LIMIT / 0.1, close), (LIMIT / 0.2, far)


def kv_error():
    """claim: Kv = 1.25 up to 0.15 Nm and 0.95 above it reduces the error; with Kv = 1 it changes sign at 0.15 Nm
    where: Lever, III.C.2, Fig. 10, Table 4
    closed_form: ((Kv tau / Ktn - 0.34 V) Kt / R) / tau - 1
    simulation: `torque_step`, `paper`, with Kv = 1 and with both Kv
    why: the torque is above 0.15 Nm. Below, the error grows. The pattern of the signs is that of the simulation
    gives: error at 0.1 Nm, Kv = 1.25 | % | near 0; at 0.3 Nm, Kv = 0.95 | % | if near 0; at 0.1 Nm, Kv = 1 | %; at 0.3
      Nm, Kv = 1 | %"""
    after = run("torque_step", "paper")[0]
    before = run("torque_step", "paper", given=(("voltage_gain", 1), ("voltage_gain_high", 1)))[0]
    low, high = before["final_error_pct.0"], before["final_error_pct.2"]
    return (error_pct(1.25, 0.1), after["final_error_pct.0"], abs(low)), \
        (error_pct(0.95, 0.3), after["final_error_pct.2"], high), (error_pct(1, 0.1), low), (error_pct(1, 0.3), high)


def kv_border():
    """claim: two regions of operation, with a gain each
    where: Lever, III.C.2, Table 4
    closed_form: (0.95 - 1.25) 0.15 Nm / Ktn times Kt / R of the 24 V winding
    simulation: `paper`, locked lever, no dead time, the set-point raised by one LSB across 0.15 Nm; a step of the PWM
      is 0.69 mNm
    why: at the border the torque falls while the user pushes deeper
    gives: change of the torque as the reference rises | mNm | at least 0"""
    more = "".join(f"[[event]]\nat_s = {at}\nset.setpoint_torque = {word / 65536!r}\n" for at, word in ((0.02, 9830), (0.1, 9831)))
    more += "[effects]\ndead_time = false\n[parameters]\ndead_voltage = 0\ndead_voltage_slope = 0"
    rows = run(scene("setpoint", 0.18, "locked", arm_s=0.002, more=more), "paper", every=3)[2]
    below, above = settled(rows, "motor_torque_nm", 0.09, 0.1), settled(rows, "motor_torque_nm", 0.17)
    return (1e3 * (0.95 - 1.25) * 0.15 / KTN * KT / OHM, 1e3 * (above.mean() - below.mean())),


def slopes():
    """claim: slopes of 0.072 Nm/V measured and 0.051 Nm/V observed
    where: Lever, III.C.1, Fig. 7
    closed_form: Measured: Kt / R. Observed: Ktn times 1 A/V, with any motor
    simulation: `calibration_open_loop`, `paper`, on `p24` and `p48`
    why: no motor has both. 0.072 is that of the 24 V winding; 0.051 is 0.0605 / 1.186 ohm, near the 48 V winding with
      its true current, whose measured slope is then the same
    gives: measured, 24 V winding | Nm/V | near 0.072 ± 0.0005; observed | Nm/V | near 0.051 ± 0.0005; measured, 48 V
      winding | Nm/V"""
    def slope(plant, of):  # 1.5 to 5.5 V
        found = run("calibration_open_loop", "paper", plant)[0]
        return (found[f"{of}_final_nm.4"] - found[f"{of}_final_nm.0"]) / 4
    return (KT / OHM, slope("p24", "torque")), (KTN, slope("p24", "tau_hat")), (None, slope("p48", "torque"))


def transparency():
    """claim: the Haptic Lever is considered to be transparent
    where: Lever, IV.E
    closed_form: A hand that swings the lever by 0.5 rad at 2 Hz feels sqrt((J a)²/2 + Fc²), as damping 4 Fc / (pi W)
    simulation: `free_lever`, `paper`
    why: the lever's own inertia and dry friction do not count: no control takes them away, and this one adds next to
      nothing
    gives: felt | mNm | at most 1; felt over what inertia and friction make | | if near 1 ± 0.02; as damping | mNm s/rad"""
    found, w = run("free_lever", "paper")[0], 2 * math.pi * 2
    felt, made = 1e3 * found["drag_rms_nm"], 1e3 * math.hypot(J * 0.5 * w * w / math.sqrt(2), COULOMB)
    return (made, felt), (1, felt / made), (1e3 * 4 * COULOMB / (math.pi * 0.5 * w), 1e3 * found["drag_damping_nm_s_rad"])
