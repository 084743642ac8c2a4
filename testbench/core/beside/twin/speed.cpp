// Ticks of run(): an armed wall, a lever that swings; events as a device would give them.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include "feltgate/axis/lever_top.hpp"
using namespace feltgate;
int main(int c, char** v) {
  std::ifstream f(v[1]);
  const long ticks = std::atol(v[2]);
  const double amplitude = c > 3 ? std::atof(v[3]) : 400;
  LeverTop t(Design::read(f));
  LeverTop::In in;
  in.reset = true; t.run(in, 5); in.reset = false;
  const auto write = [&](int a, std::uint32_t w) { in.port = {a, w, true}; do t.clock(in); while (t.out(in).reg_busy); in.port.write = false; };
  write(Map::A::self_test_pulse, 0); write(0x200, 1); write(0x201, 2);
  t.run(in, 500);
  write(0x200, 3 | 9 << 2); t.run(in, 500);
  std::printf("armed %d clock %d\n", t.out(in).safety.armed, t.out(in).tick.clock);
  t.run(in, 50 - t.out(in).tick.clock);
  std::vector<EncoderEvent> events; int at = 0, ab = 0; double phase = 0; long n = 0, edges = 0;
  const int table[4] = {0, 1, 3, 2};
  for (long k = 0; k < ticks; k += 20) {  // a period of the PWM at once, as a plant's step
    events.clear();
    for (int c2 = 0; c2 < 1000; c2 += 125) { phase += 2 * 3.14159 * 2 * 125 / 50e6; int want = (int)std::floor(amplitude * std::sin(phase));
      if (want != at) { at += want > at ? 1 : -1; ab = table[at & 3]; events.push_back({c2, {(ab & 2) != 0, (ab & 1) != 0, false}}); ++edges; } }
    t.run(in, 1000, events.data(), events.data() + events.size()); n += 20;
  }
  std::printf("%ld ticks, %ld edges, %ld whole, %ld thrown, duty %ld armed %d\n", n, edges, t.whole, t.thrown, (long)t.out(in).snapshot.duty, t.out(in).safety.armed);
}
