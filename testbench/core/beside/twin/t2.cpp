#include <cstdio>
#include <fstream>
#include "feltgate/axis/lever_top.hpp"
using namespace feltgate;
int main(int, char** v) {
  std::ifstream f(v[1]); const Design d = Design::read(f); LeverTop t(d); LeverTop::In in;
  in.reset = true; t.clock(in); in.reset = false;
  const auto write = [&](int a, std::uint32_t w) { in.port = {a, w, true}; do t.clock(in); while (t.out(in).reg_busy); in.port.write = false; };
  write(0x200, 1 | 7 << 2); t.run(in, 5 * d["CLOCKS_PER_TICK"]); while (t.out(in).tick.clock != 0) t.clock(in);
  for (int k = 0; k < 2 * d["CLOCKS_PER_TICK"]; ++k) { auto o = t.out(in); if (o.tick.duty) std::printf("charge: duty valid in clock %d\n", o.tick.clock); if (o.word.valid) std::printf("  word %d in clock %d\n", o.word.place, o.tick.clock); t.clock(in); }
  // Real beside Fixed: a wall, velocity and observer from the same counts.
  using R = Real<double>; Words<double> p; Words<std::int64_t> q; WordFormats wf(d);
  for (const Word& w : d.words) { wf.load(q, w.address, w.reset); if (w.address < 64) if (auto m = Words<double>::common(w.address)) p.*m = w.reset * R::power(-w.fraction); }
  for (int place : ParamsMemory::places) for (const Word& w : d.words) if (w.address == 9 * 32 + place) wf.load_scene(q, place, w.reset);
  for (const Word& w : d.words) { const double x = w.reset * R::power(-w.fraction); if (w.name == "wall_contact") p.first = x; if (w.name == "wall_stiffness") p.stiffness = x; if (w.name == "wall_damping") p.damping = x; }
  VelocityEstimator<R> ve(d); Observer<R> ob(d); Scene<R> sc(d); Ramp<R> ra(d); TorqueLaw<R> tl(d);
  VelocityEstimator<Fixed> ve2(d); Observer<Fixed> ob2(d); Scene<Fixed> sc2(d); Ramp<Fixed> ra2(d); TorqueLaw<Fixed> tl2(d);
  VelocityEstimator<R>::State a; Observer<R>::State b; Scene<R>::State c; Ramp<R>::State e; TorqueLaw<R>::State g;
  VelocityEstimator<Fixed>::State a2; Observer<Fixed>::State b2; Scene<Fixed>::State c2; Ramp<Fixed>::State e2; TorqueLaw<Fixed>::State g2;
  for (int k = 0; k < 20000; ++k) {
    const std::int16_t n = static_cast<std::int16_t>(k % 8000 < 4000 ? 5 : -5); const std::int64_t pos = 300 + k % 100;
    a = ve.tick(a, p, n); b = ob.tick(b, p, true, g.current, a.velocity); c = sc.tick(c, p, true, 9, pos, a.velocity, {}); e = ra.tick(e, p, {true, 9, false, false, false, c.torque}); g = tl.tick(g, p, true, 0, e.tau_ref, b.tau_hat, a.velocity);
    a2 = ve2.tick(a2, q, n); b2 = ob2.tick(b2, q, true, g2.current, a2.velocity); c2 = sc2.tick(c2, q, true, 9, pos, a2.velocity, {}); e2 = ra2.tick(e2, q, {true, 9, false, false, false, c2.torque}); g2 = tl2.tick(g2, q, true, 0, e2.tau_ref, b2.tau_hat, a2.velocity);
  }
  const auto s = [&](std::int64_t x, const char* fr) { return static_cast<double>(x) * R::power(-d[fr]); };
  std::printf("velocity %.6f %.6f, tau_hat %.6f %.6f, tau_ref %.6f %.6f, current %.6f %.6f, voltage %.5f %.5f, duty %.2f %lld\n", a.velocity, s(a2.velocity, "VELOCITY_F"), b.tau_hat, s(b2.tau_hat, "TORQUE_F"), e.tau_ref, s(e2.tau_ref, "TORQUE_F"), g.current, s(g2.current, "CURRENT_F"), g.voltage, s(g2.voltage, "VOLTAGE_F"), g.duty, (long long)g2.duty);
}
