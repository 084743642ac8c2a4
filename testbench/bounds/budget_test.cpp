// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
#include "budget/budget.hpp"

#include "catch.hpp"
TEST_CASE("x"){ auto b=feltgate::bounds::make_budget("lever"); feltgate::ChainIn in; 
 for(int i=0;i<100000;i++){ in.travel=static_cast<std::int16_t>(i/100); in.position=i/100; in.armed=i>1000; in.scene=6; b->tick(in);} 
 for(auto&r:b->rows()) printf("%-16s %g %g %g %g\n",r.name.c_str(),r.velocity_rad_s.max(),r.tau_hat_nm.max(),r.tau_ref_nm.max(),r.current_a.max()); }
