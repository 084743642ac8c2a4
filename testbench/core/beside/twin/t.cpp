#include "feltgate/axis/lever_top.hpp"
#include <fstream>
int main(int, char** v) { std::ifstream f(v[1]); feltgate::LeverTop t(feltgate::Design::read(f)); feltgate::LeverTop::In in; for (int k=0;k<1000;++k) t.clock(in); return t.out(in).tick.clock; }
