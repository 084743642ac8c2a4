# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Claims of the other four papers: for each a function, as claims.py says. Documentation: docs/claims.md"""
import functools
import math

import numpy as np

from paper_claims.lever import COULOMB, J
from paper_claims.simulations import COUNT, feltgate, largest, pushed, radius, run, settled, stiffest

# ---- A wrist device
HARD, SOFT, TRACKER_HZ, ENCODER_HZ, NOISE = 2 * 180 / math.pi, 0.2 * 180 / math.pi, 144, 490, 0.05 * math.pi / 180


# Of a host's wall: stiffness, noise, smoothing.
JITTERS = ((SOFT, 0, 1), (SOFT, NOISE, 1), (SOFT, NOISE, 0.5), (4.2, NOISE, 0.5), (4.8, NOISE, 0.5), (4.8, NOISE / 2, 0.5))


@functools.lru_cache(None)
def jitters_mnm(tries=40, dt=5e-5):
    """Rms of these walls' torques from 1 s to 2 s, mean of some tries: the lever of p24 with its dry friction (LuGre), an
    ideal motor, and a hand of 0.554 kg, 6.45 Ns/m, 135 N/m with a grip of 3000 N/m, 10 Ns/m, all at 0.1 m. The hand aims
    15 mrad behind the face, which makes 20 mNm."""
    k, noise, smoothing = np.repeat(np.array(JITTERS), tries, axis=0).T
    lever, hand, smooth = (np.full(len(k), -0.05) for _ in range(3))
    speed, hand_speed, bristle, torque = np.zeros((4, len(k)))
    draw, torques, every = np.random.default_rng(1), [], round(1 / TRACKER_HZ / dt)
    for step in range(round(2 / dt)):
        if step % every == 0:
            smooth = smooth + smoothing * (lever + noise * draw.normal(size=len(k)) - smooth)
            torque = np.minimum(0, -k * smooth)
            torques += [torque] if step * dt > 1 else []
        sliding = speed - 40 * np.abs(speed) / (COULOMB + 1e-3 * np.exp(-(speed / 0.5) ** 2)) * bristle
        grip = 30 * (hand - lever) + 0.1 * (hand_speed - speed)
        speed = speed + dt / J * (torque + grip - 40 * bristle - 0.02 * sliding)
        hand_speed = hand_speed + dt / 5.54e-3 * (1.35 * (0.015 - hand) - 0.0645 * hand_speed - grip)
        lever, hand, bristle = lever + dt * speed, hand + dt * hand_speed, bristle + dt * sliding
    return dict(zip(JITTERS, 1e3 * np.std(torques, axis=0).reshape(-1, tries).mean(axis=1)))


def noise_not_rate():
    """claim: noise makes the wall jitter, and 144 Hz does not; smoothing with 0.5 reduces it
    where: Wrist, Determining the Cause of Instability; Filtering
    closed_form: A low rate shakes a wall where b < K T / 2; smoothing leaves sqrt(a / (2 - a)) of white noise
    simulation: a host's wall of 0.2 Nm/deg at 144 Hz on the lever of `p24` in real numbers, a hand leaning on its face,
      mean of 40 tries of 1 s; 0.05 degrees of noise are ours
    why: a hand is on the lever, whose 0.065 Nm s/rad are above K T / 2
    gives: rms without noise | mNm | if at most 0.1; rms with noise | mNm | if at least 1; share left by smoothing | |
      if at most 0.7; K T / 2 | Nm s/rad"""
    noisy = jitters_mnm()[SOFT, NOISE, 1]
    return (None, jitters_mnm()[SOFT, 0, 1]), (None, noisy), \
        (math.sqrt(0.5 / 1.5), jitters_mnm()[SOFT, NOISE, 0.5] / noisy), SOFT / (2 * TRACKER_HZ)


def ceiling():
    """claim: a ceiling of 700 N/m works; instability is noticeable above 800 N/m
    where: Wrist, Fig. 5; Conclusion & Next Steps
    closed_form: T = k d² jitters by about 2 k d l times the noise, of which smoothing leaves 0.577; nothing sets 700 or
      800 apart
    simulation: a host's wall as stiff as these ceilings are 10 mm deep on a stick of 0.3 m (both ours), 144 Hz,
      smoothed, as `noise_not_rate`
    why: the noise of the tracker, the depth and the stick's length are not given. Half the noise allows twice the
      stiffness
    gives: stiffness at 700 N/m | Nm/rad; jitter at 700 N/m | mNm; at 800 N/m | mNm; at 800 N/m, half the noise | mNm"""
    closed = lambda k, noise: 1e3 * 2 * k * 0.01 * 0.3 * noise * math.sqrt(0.5 / 1.5)
    seven, eight, half = (jitters_mnm()[case] for case in JITTERS[3:])
    return 2 * 700 * 0.01 * 0.3, (closed(700, NOISE), seven), (closed(800, NOISE), eight), (closed(800, NOISE / 2), half)


def encoder_wall():
    """claim: with the encoder (AS5048A) a wall of 2 Nm/deg is unstable only at its very border
    where: Wrist, VR Tracking vs. Encoder Feedback, Fig. 3
    closed_form: 14 bits: 2 pi / 16384 a count. Between two counts a wall hunts unless friction holds K q / 2; at 490 Hz
      it needs b > K T / 2
    simulation: `lever` pressed half way between two counts, with the same torque a count; friction of `p24`, and 30 mNm
    why: motor and hand hold 22 mNm. With the friction of our lever it hunts wherever it rests between two counts
    gives: a count | mrad; torque of a count | mNm; friction that it needs | mNm; damping that it needs | Nm s/rad;
      presses at rest, 3.5 mNm | | at least 1; presses at rest, 30 mNm | | if at least 1"""
    count, step = 2 * math.pi / 16384, HARD * 2 * math.pi / 16384
    def quiet(friction):  # our count is four times as large, so a quarter of the stiffness makes the same step
        def still(press):
            found = run(pushed(0.7, ("minimum_jerk", 0.2, press * step), step, "[rest]\nfrom_s = 0.5\n"),
                        constants=(("coulomb_nm", friction), ("static_nm", 1.1 * friction)))[0]
            return found["rest_tau_ref_rms_nm"] < step / 100
        return (still(2.5) + still(3.5)) / 2
    return 1e3 * count, 1e3 * step, 1e3 * step / 2, HARD / (2 * ENCODER_HZ), (0, quiet(3.5e-3)), (1, quiet(30e-3))


def pole_pairs():
    """claim: the motor has 14 pole pairs, so rotation is smooth
    where: Wrist, Hardware Selection
    closed_form: Six steps a pair leave torque between cos 30° and 1 whatever the number of pairs; pairs set how often,
      and an angle of the encoder is 14 times as large for the field
    simulation: the two of three sinusoidal phases that make the most torque, over a turn, with 14 pairs and with one
    why: what smooths is the drive: a field that follows the angle has no ripple with any number of pairs. Slots and
      cogging are not given
    gives: ripple of six steps | %; ripple, 14 pairs over 1 | | at most 0.5; ripples a turn; a count of the encoder for
      the field | °"""
    turn = np.linspace(0, 2 * math.pi, 100001)
    def ripple(pairs):
        line = np.ptp(np.sin(pairs * turn - 2 * math.pi / 3 * np.arange(3)[:, None]), axis=0)
        return 1 - line.min() / line.max()
    return (100 * (1 - math.cos(math.pi / 6)), 100 * ripple(14)), (1, ripple(14) / ripple(1)), 6 * 14, 14 * 360 / 16384


# ---- Haptic Hunt: of the force 0.7, of the velocity 0.95 of the value before stay in each run of 1 ms
HUNT_S, KEPT_S, V_KEPT = 1e-3, 0.7 / 0.3 * 1e-3, 0.95
PEN = {"m": 0.1, "T": HUNT_S}  # the mass is ours
NEEDED = 50 * (HUNT_S / 2 + KEPT_S)  # friction at which 50 N/m are the border, Ns/m


def recognition():
    """claim: 52 of 70 guesses were right, 74.3 %, above the 14.3 % of random guessing
    where: Hunt, 4.2
    closed_form: 52 / 70; 1 / 7; always "fish", which was there 34 times of 70
    simulation: -: people are not simulated; a [blind robot](devices/shapes.md#a-blind-robot) is, right in 78 % without
      the cues of stiffness and damping and in 88 % with both, where its memory errs by 10 degrees per √cm
    why: it does. Who knows that fish comes first and always says so is right in 48.6 %; 74.3 % is above that too, by
      4.3 standard deviations
    gives: right | % | near 74.3 ± 0.05; random guessing | % | near 14.3 ± 0.05; always "fish" | %; 52 above always
      "fish", standard deviations"""
    return 100 * 52 / 70, 100 / 7, 100 * 34 / 70, (52 - 34) / math.sqrt(70 * (34 / 70) * (36 / 70))


def walls_50():
    """claim: 50 N/m is the stiffest wall before the device becomes unstable
    where: Hunt, 3.2, Table 1
    closed_form: b / (T/2 + 0.7/0.3 T): the force's filter lags too
    simulation: eigenvalues of a mass of 0.1 kg (ours) with the filter at 1 kHz; on the twin:
      [pantograph_wall](devices/pantograph_wall.md)
    why: the pen has 0.142 Ns/m of friction, which is not given; without the filter that would carry 283 N/m
    gives: friction that 50 N/m needs | Ns/m; stiffest wall then | N/m | if near 50 ± 2.5; without the filter | N/m"""
    return NEEDED, (NEEDED / (HUNT_S / 2 + KEPT_S), stiffest(50, b=NEEDED, lag=KEPT_S, **PEN)), \
        (NEEDED / (HUNT_S / 2), stiffest(50, b=NEEDED, **PEN))


def damping_003():
    """claim: the highest damping before instability was 0.03 Ns/m
    where: Hunt, 3.2
    closed_form: Of the border of a damper on a mass, both filters and a run late, w = 1 / sqrt(t1 t2), t1 = 19 ms of 95
      % and t2 = 2.33 ms of 70 % with a run: B = m w sqrt((1 + (w t1)²)(1 + (w t2)²)). 0.5 m/s is the largest velocity
      that they use
    simulation: eigenvalues as `walls_50`, with the velocity's filter
    why: the loop carries a thousand times as much. 0.03 Ns/m is a fifth of the friction that their 50 N/m need, and 15
      mN at most: what shook is the noise of the velocity, whose counts are not given
    gives: largest damping | Ns/m | near 0.03 ± 0.01; friction that 50 N/m needs, over it; largest force of the damping
      | mN"""
    t1, t2 = V_KEPT / (1 - V_KEPT) * HUNT_S, KEPT_S + HUNT_S
    w = 1 / math.sqrt(t1 * t2)
    closed = 0.1 * w * math.sqrt((1 + (w * t1) ** 2) * (1 + (w * t2) ** 2))
    found = largest(lambda B: radius(30, b=NEEDED, bv=B, lag=KEPT_S, kept=V_KEPT, **PEN) < 1, 0.01)
    return (closed, found), NEEDED / 0.03, 1e3 * 0.03 * 0.5


def two_controllers():
    """claim: a second microcontroller delays, and the wall becomes jumpy and oscillates
    where: Hunt, 3.2, Signal Smoothing and Stabilization
    closed_form: b / (T/2 + 0.7/0.3 T + td), with the friction at which 50 N/m are the border (`walls_50`)
    simulation: eigenvalues, as `walls_50`
    why: the delay, which is not given, is a number of four bytes at 115 200 baud and a run: it takes a third of the
      stiffness
    gives: delay | ms; stiffest wall | N/m | if at most 40"""
    delay = 4 * 10 / 115200 + HUNT_S  # ten bits a byte
    return 1e3 * delay, (NEEDED / (HUNT_S / 2 + KEPT_S + delay), stiffest(30, b=NEEDED, lag=KEPT_S, dead=delay, **PEN))


def maxon():
    """claim: the Maxon motor has 8 times the torque at 5 V; limited to 2.1 V, for the driver's 2 A, like 3 times
    where: Hunt, 9.1, Encoders and motor selection
    closed_form: Torque at stall is Kt V / R, so 8 times 2.1 V / 5 V; the winding is 2.1 V / 2 A, and heats by 2.1 V 2 A
    simulation: -: arithmetic
    why: both numbers come from one winding, of 1.05 ohm
    gives: torque at 2.1 V | times | near 3 ± 0.5; winding | ohm; stall current at 5 V | A | at least 2; heat at 2.1 V |
      W"""
    return 8 * 2.1 / 5, 2.1 / 2, 5 / (2.1 / 2), 2.1 * 2


def attraction():
    """claim: a force pulls the user towards the shape, up to a threshold pT where he sits
    where: Hunt, 9.1, Force Feedback Model
    closed_form: -
    simulation: -: pT has no value, and neither has the slope
    why: no number is given; the final device left it out, since users took the pull for the shape"""
    return []


# ---- TouchWorld
DEVICE_B, VIRTUAL_B, STYLUS, WALL, MOST_N = 0.003, 0.1, 0.045, 206, 3.3


def stylus(bv, T, mass=STYLUS):
    """The document's loop: a force held for T, velocity by backward difference. Its border is 2 (b + bv) / T."""
    return stiffest(2 * (DEVICE_B + bv) / T, m=mass, b=DEVICE_B, T=T, bv=bv)


def border():
    """claim: the stiffest walls are 6, 106, 206 and 406 N/m at 1 kHz, 412 at 2 kHz, 1030 at 5 kHz; the transition is
      precisely at 206
    where: TouchWorld, V, Fig. 17, 18, table; Future Work II
    closed_form: 2 (b + bv) / T with b = 0.003 Ns/m
    simulation: eigenvalues of the document's own loop: a held force, velocity by backward difference, 45 g
    why: for its own loop, within 0.5 % for 45 g. It is the border of a mass alone, neither Llewellyn's condition nor
      passivity, which virtual damping does not help
    gives: bv 0 Ns/m at 1 kHz | N/m | near 6 ± 0.03; bv 0.05 Ns/m at 1 kHz | N/m | near 106 ± 0.53; bv 0.1 Ns/m at 1 kHz
      | N/m | near 206 ± 1.03; bv 0.2 Ns/m at 1 kHz | N/m | near 406 ± 2.03; bv 0.1 Ns/m at 2 kHz | N/m | near 412 ±
      2.06; bv 0.1 Ns/m at 5 kHz | N/m | near 1030 ± 5.15; 206 N/m with 10 g | N/m; 206 N/m with 1 kg | N/m"""
    walls = (0, 1), (0.05, 1), (0.1, 1), (0.2, 1), (0.1, 2), (0.1, 5)
    return [(2e3 * khz * (DEVICE_B + bv), stylus(bv, 1e-3 / khz)) for bv, khz in walls] + [
        (None, stylus(0.1, 1e-3, 0.01)), (None, stylus(0.1, 1e-3, 1))]


def margin():
    """claim: at 206 N/m the system is well within the bound, with no oscillation
    where: TouchWorld, V, Fig. 19
    closed_form: 1 - 206 / 206 of the stiffness is left; a swing grows by (K - Kmax) T / (4 m) or so
    simulation: eigenvalues of the same loop: growth of a swing at 206 N/m, below 0 it decays
    why: 206 N/m is the bound itself (we take 10 % for well within). At half of it, 103 N/m, a swing decays
    gives: share of the bound that is left | % | at least 10; growth at 206 N/m | 1/s; growth at 103 N/m | 1/s"""
    growth = lambda k: math.log(radius(k, STYLUS, DEVICE_B, 1e-3, VIRTUAL_B)) / 1e-3
    return (0, 100 * (1 - WALL / stylus(VIRTUAL_B, 1e-3))), (0, growth(WALL)), \
        ((103 - 206) * 1e-3 / (4 * STYLUS), growth(103))


def z_width():
    """claim: a Z-width of approximately 1093 at 1 kHz, nearly doubled at 2, quintupled at 5
    where: TouchWorld, V, Fig. 20
    closed_form: Kmax / (b 2 pi 10 Hz), which is our reading: the paper gives no frequency
    simulation: eigenvalues of the same loop
    why: the free impedance is that at 10 Hz
    gives: at 1 kHz | | if near 1093 ± 5.465; at 2 kHz | | if near 2186 ± 10.93; at 5 kHz | | if near 5465 ± 27.325"""
    free = DEVICE_B * 2 * math.pi * 10
    return [(2e3 * khz * 0.103 / free, stylus(VIRTUAL_B, 1e-3 / khz) / free) for khz in (1, 2, 5)]


def phantom_z_width():
    """claim: early PHANToM devices had a Z-width of 100 to 300; 1093 is above
    where: TouchWorld, V, Z-width
    closed_form: Kmax / (b 2 pi f): a ratio that falls with the frequency, which neither number comes with; without
      virtual damping it is 1 / (pi f T) for any device
    simulation: eigenvalues of the same loop at 10 and at 100 Hz
    why: no source, no frequency, no rate. The same device and wall have 300 at 36 Hz and 109 at 100 Hz; the damping of
      the wall is in Kmax, but not in the free impedance
    gives: at 10 Hz; at 100 Hz | | at least 300; 300 at | Hz; without virtual damping, 10 Hz"""
    width = lambda hz: tuple(k / (DEVICE_B * 2 * math.pi * hz) for k in (2e3 * 0.103, stylus(VIRTUAL_B, 1e-3)))
    return width(10), width(100), 2e3 * 0.103 / (DEVICE_B * 2 * math.pi * 300), 1 / (math.pi * 10e-3)


def plugin_value():
    """claim: the bound of 206 N/m is a plugin value of 0.65 to 0.75, where instability began: a cross-validation
    where: TouchWorld, V; Results
    closed_form: The plugin's full scale, 206 N/m over the value, is not known: one number is fitted to one observation
    simulation: -: the plugin is closed
    why: any bound fits with a scale of its own, also 100 or 400 N/m. A second rate or damping would test it. Its own
      preset of 0.8 is above the border
    gives: full scale, least | N/m; full scale, largest | N/m; observations left beyond the fitted scale | | at least 1;
      preset of 0.8 over the value 0.75 of the border"""
    return WALL / 0.75, WALL / 0.65, 1 - 1, 0.8 / 0.75


def zeta():
    """claim: hDamping = 0.1 is near critical: zeta is about 1
    where: TouchWorld, VI.4, Fig. 27, Table 3
    closed_form: b / (2 sqrt(k m)) with 0.103 Ns/m, 206 N/m, 45 g; the mass for zeta = 1 is b² / (4 k)
    simulation: eigenvalues of the same contact in steps of 10 µs: decay of the swing over its frequency
    why: a swing takes 37 periods to fall to 2 %. Critical would be a stylus of 13 mg
    gives: zeta | | near 1 ± 0.1; mass for zeta = 1 | mg"""
    b, step = DEVICE_B + VIRTUAL_B, 1e-5
    decay = -math.log(radius(WALL, STYLUS, b, step)) / step + WALL * step / (4 * STYLUS)  # and what the hold takes
    return (b / (2 * math.sqrt(WALL * STYLUS)), decay / math.sqrt(WALL / STYLUS)), 1e6 * b * b / (4 * WALL)


def saturation():
    """claim: at 206 N/m the total force reaches 3.3 N at approximately 14 mm
    where: TouchWorld, V, Fig. 16
    closed_form: 3.3 N / 206 N/m; at 14 mm the spring has 206 N/m times 14 mm
    simulation: `lever` with a wall of 206 N/m at 0.1 m, a hand that pushes with 3.3 N, friction of `p24`
    why: friction and damping add 0.42 N, for which the figure gives neither speed nor coefficient. The spring alone is
      16 mm deep
    gives: depth at 3.3 N | mm | near 14 ± 0.5; depth of the spring's share | mm | if near 14 ± 0.5; spring at 14 mm |
      N; left for the rest | N"""
    def depth_mm(newton):
        rows = run(pushed(0.6, ("ramp", 0.4, 0.1 * newton), WALL * 0.01 * COUNT), every=50)[2]
        return 100 * settled(rows, "theta_rad", 0.5).mean()
    return (1e3 * MOST_N / WALL, depth_mm(MOST_N)), (1e3 * (MOST_N - 0.42) / WALL, depth_mm(MOST_N - 0.42)), WALL * 14e-3, \
        MOST_N - WALL * 14e-3


def texture(row, x, below, texel, depth, k, facets=False):
    """Force on a pen `below` black along a row of pixels, shares of the depth: k along the normal in the texture, k upright
    below. A normal is that of the line between two pixels, or between its neighbours (shaded)."""
    q = np.asarray(x) / texel
    def height(at):
        return np.interp(at, np.arange(len(row)), row)
    slope = depth / texel * (height(np.floor(q) + 1) - height(np.floor(q)) if facets else (height(q + 1) - height(q - 1)) / 2)
    within = np.minimum(np.maximum(below + depth * height(q), 0), depth * height(q))
    lower, upright = np.maximum(below + depth * height(q), 0) - within, 1 / np.sqrt(1 + slope**2)
    return -k * within * slope * upright, k * (within * upright + lower)


def force_error(pixels, facets):
    """Rms of the sideways force along a sine of so many pixels, slopes to 0.2, less that of the smooth curve; relative."""
    at, per = np.arange(pixels, 5 * pixels, 0.0613), 2 * math.pi / pixels
    depth = 0.4e-3 / per
    felt = texture(0.5 + 0.5 * np.sin(per * np.arange(6 * pixels + 1)), at * 1e-3, 2e-3, 1e-3, depth, 500, facets)[0]
    slope = 0.2 * np.cos(per * at)
    right = -500 * depth * (0.5 + 0.5 * np.sin(per * at)) * slope / np.sqrt(1 + slope**2)
    return math.sqrt(((felt - right) ** 2).sum() / (right**2).sum())


def force_shading():
    """claim: force shading reduces the rms error of the force by up to 36 % on coarse meshes
    where: TouchWorld, Future Work VII
    closed_form: On a low sine of N facets a period, h = 2 pi / N, s = sinc h/2, c = sinc h: facets miss sqrt(1 - s²) of
      the slope, shading sqrt(1 - 2 c s² + c² (2 + cos h)/3)
    simulation: a row of pixels in real numbers, slopes to 0.2, sideways force against the smooth curve's
    why: a bump has about 8 facets (to 6 %): 35 % of the slope's error, 41 % of the force's. With 16 it is 66 and 70 %
    gives: reduction, 8 facets | % | if near 36 ± 6; 16 facets | %"""
    def reduction(pixels):
        h = 2 * math.pi / pixels
        s, c = math.sin(h / 2) / (h / 2), math.sin(h) / h
        closed = math.sqrt(1 - 2 * c * s * s + c * c * (2 + math.cos(h)) / 3) / math.sqrt(1 - s * s)
        return 100 * (1 - closed), 100 * (1 - force_error(pixels, False) / force_error(pixels, True))
    return reduction(8), reduction(16)


def triangles():
    """claim: coarse meshes support higher stiffness; 500 000 triangles break 1 kHz
    where: TouchWorld, V, mesh resolution; III.2
    closed_form: Neighbouring facets of edge h on a radius R turn by h / R, and h goes as 1 / sqrt(F): the jump of the
      force at an edge is larger on a coarse mesh. The border 2 (b + B) / T has no mesh in it. A tree looks at 2 log2 F
      boxes a contact
    simulation: error of the force on facets of a sine, 8 facets a period beside 31, as 8000 triangles are beside 122
      700
    why: a coarse mesh has fewer, but larger jumps. Only who looks at all 500 000 in each run has 2 ns for each; their
      own physics engine has a tree, and 50 Hz
    gives: jump, 8000 over 122 700 triangles | | at most 1; time for each of 500 000 | ns; looked at in a tree | | at
      least 500000.0"""
    ratio = math.sqrt(122700 / 8000)
    return (ratio, force_error(8, True) / force_error(31, True)), 1e6 / 5e5, 2 * math.log2(5e5)


def mesh():
    """claim: meshes of objects have 61 324 vertices and 122 700 faces
    where: TouchWorld, VI.2, Fig. 24
    closed_form: Euler's V - E + F with E = 3 F / 2 is V - F / 2; the genus of a closed surface is 1 - half of it
    simulation: -: the mesh is not given
    why: for one closed, clean object: it would have 14 handles. More likely there are several shells or defects
    gives: V - F / 2; handles of one closed object | | at most 0"""
    euler = 61324 - 122700 / 2
    return euler, 1 - euler / 2


def preset():
    """claim: all objects have stiffness 0.8, damping 0.1, static friction 0.4, dynamic 0.3
    where: TouchWorld, VI.4, Table 3
    closed_form: Shares of the hardest surface and of the largest damping; ours are 4 Nm/rad and 50 mNm s/rad
      ([material](devices/material.md))
    simulation: -: this table runs no laws; `./feltgate run material_object` does
    why: the shares are those of our law, whose own values they are. The paper gives no units, so nothing can be
      compared in newtons. The preset's name is `material_object`
    gives: stiffness | Nm/rad; damping | mNm s/rad; dynamic over static friction | | if at most 1"""
    return 0.8 * 4, 0.1 * 50, 0.3 / 0.4


# ---- DIMPLE and textures. A quaternion is w, x, y, z.
def product(a, b):
    return (a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3], a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
            a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1], a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0])


def inverse(q):
    return q[0], -q[1], -q[2], -q[3]


def left_deg(device, object_, error):
    """A ball on a spring (4) and damper (2) along error(device, object): the angle that is left after 10 s."""
    speed, dt = [0.0] * 3, 1e-3
    for _ in range(10000):
        q = error(device, object_)
        speed = [v + dt * (8 * math.copysign(1, q[0]) * e - 2 * v) for v, e in zip(speed, q[1:])]
        moved = [x + dt / 2 * r for x, r in zip(object_, product((0, *speed), object_))]
        object_ = [x / math.hypot(*moved) for x in moved]
    return math.degrees(2 * math.acos(min(1, abs(product(device, inverse(object_))[0]))))


def quaternion():
    """claim: qd qo^-1 gives the torque; qd^-1 qo resulted in a singularity
    where: DIMPLE, 4, eq. 1
    closed_form: The last three elements of qd qo^-1 are the axis times sin(phi/2): the torque is 2 k sin(phi/2), k phi
      for small angles
    simulation: a ball on that spring with damping, from 90° about x towards 90° about z; the axis itself in `./feltgate
      run gimbal`
    why: a failure is meant: the other order has no singularity. It is the same error with the other sign and in the
      device's frame, so in the frame of the world it pushes away. The flip at 360° is a missing sign of the first
      element
    gives: its elements, Rz 90° and Rx 90°: w; x; y; z; torque at 90° over k; angle left by qd qo^-1 | ° | if at most
      0.1; left by qd^-1 qo | ° | if at least 45"""
    half = math.sqrt(0.5)
    device, ball = (half, 0, 0, half), (half, half, 0, 0)
    error = product(device, inverse(ball))
    left = left_deg(device, ball, lambda d, o: product(d, inverse(o)))
    return *zip((0.5, -0.5, -0.5, 0.5), error), 2 * math.sin(math.pi / 4), (0, left), \
        (None, left_deg(device, ball, lambda d, o: product(inverse(d), o)))


def plane(row, x, below, texel):
    """Upright and whole force over k of the plane through two pixels only, with slopes of texel / texel: it ends where the
    normal leaves the texel."""
    q = x / texel
    i = np.floor(q).astype(int)
    slope = (row[i + 1] - row[i])
    upright = 1 / np.sqrt(1 + slope**2)
    depth = (below + texel * (row[i] + slope * (q - i))) * upright
    room = np.where(slope > 0, q - i, i + 1 - q) * texel / np.maximum(np.abs(slope) * upright, 1e-12)
    depth = np.minimum(np.maximum(depth, 0), room)
    return depth * upright, depth


def texture_stiffness():
    """claim: as texels get smaller, k has to grow by several magnitudes to feel the same
    where: DIMPLE, 5.1
    closed_form: The depth along a texel's normal ends at s / (2 sin a): at a slope of 45° and 3 mm deep, k grows by 2
      sin 45° 3 mm / s. With the depth split in two the part below has the full k
    simulation: planes of texels of s in real numbers; with the split, a sine, share of k felt to 3 mm
    why: k grows as 1/s: two magnitudes for s = 0.04 mm. Split, it stays
    gives: k, texels of 1 mm, factor; texels of 0.01 mm, factor | | at least 100; share with the split, 0.1 over 10 mm |
      | near 1 ± 0.01; without, 0.1 over 10 mm"""
    without = lambda s: 3e-3 / plane(np.array([0.0, 1.0]), np.array([s / 2]), 3e-3, s)[1][0]
    def firm(s):  # gained from black to 3 mm below it, on average of 101 places within the pen's reach
        row = 0.5 + 0.5 * np.sin(2 * math.pi * np.arange(97) / 16)
        at = 48 * s + min(0.05, 48 * s) * (2 * (np.arange(101) + 0.5) / 101 - 1)
        both = lambda below: np.array([texture(row, at, below, s, s, 1)[1], plane(row, at, below, s)[0]])
        return (both(3e-3) - both(0)).mean(axis=1) / 3e-3
    bounded = 2 * math.sin(math.pi / 4) * 3e-3
    small, large = firm(0.1e-3), firm(10e-3)
    return (bounded / 1e-3, without(1e-3)), (bounded / 0.01e-3, without(0.01e-3)), (1, small[0] / large[0]), \
        (None, small[1] / large[1])


def texture_force():
    """claim: the depth split in texture and surface gives lateral force, and is stiff to the surface
    where: DIMPLE, 5.1, F = dt k nt + ds k ns
    closed_form: 0.8 mm high, 0.5 mm below the surface, normal (0.6, 0, 0.8), 1000 N/m: our example
    simulation: a ramp of texels of 1 mm, five steps of 0.75 mm down, in real numbers; in the engine's words in
      [shapes](devices/shapes.md)
    why: it does. It points a little more upward than the texture, as the report says
    gives: sideways | N | near 0.48 ± 0.001; upward | N | near 1.14 ± 0.001"""
    x, y = texture([1, 0.8, 0.6, 0.4, 0.2, 0], (3.75 - 0.8) / 0.75 * 1e-3, 0.5e-3, 1e-3, 3.75e-3, 1000)
    return (0.8e-3 * 1000 * 0.6, float(x)), (0.8e-3 * 1000 * 0.8 + 0.5e-3 * 1000, float(y))


def forty_khz():
    """claim: a device at 40 kHz, with a bridge over the bus approximately 1 kHz: what is lost?
    where: DIMPLE, 3, 6
    closed_form: The stiffest wall is (b + B) / (T/2 + td): 40 times as stiff at 40 kHz without a delay td, less with
      one
    simulation: eigenvalues: a mass of 0.1 kg, an ideal actuator; and `lever` on plant `linear`, B = 0.005 Nms/rad
    why: the actuator is ideal. On our lever the winding's 0.2 ms leaves a factor of about 3
    gives: 40 kHz over 1 kHz, `lever` | | at least 38; ideal actuator | | if near 40 ± 2; `lever` at 1 kHz | Nm/rad; at
      40 kHz | Nm/rad"""
    words = "stability lever --rate 1000,40000 --damping 0.005 --no-bits"
    slow, fast = feltgate(*words.split())["borders"]
    closed, found = "closed_nm_rad", "eigenvalues_nm_rad"
    ideal = [stiffest(0.206 / T, m=0.1, b=0.103, T=T) for T in (25e-6, 1e-3)]
    return (fast[closed] / slow[closed], fast[found] / slow[found]), (40, ideal[0] / ideal[1]), (slow[closed],
              slow[found]), \
        (fast[closed], fast[found])


def bow():
    """claim: at least five degrees of force feedback are necessary for a full violin bowing simulation
    where: DIMPLE, 3, 6-DOF bowing simulation
    closed_form: A hair of no width touches at r = x e: forces in three directions, and torques r × F in the two across
      the hair: 3 + 2
    simulation: rank of 1000 random contacts along the hair: forces at x e, and the torques that they make at the frog
    why: it is the count for a line of hair; a ribbon adds the torque of its tilt, the sixth
    gives: degrees, a line of hair | | near 5 ± 0; degrees, a ribbon"""
    force, at = np.random.default_rng(1).normal(size=(2, 1000, 3))
    def rank(width):
        return float(np.linalg.matrix_rank(np.hstack([force, np.cross(at * [1, width, 0], force)])))
    return (5, rank(0)), (6, rank(0.01))
