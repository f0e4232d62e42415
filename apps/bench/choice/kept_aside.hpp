#pragma once
#include <string>

#include "apps/bench/comparison.hpp"

/// Problems on which no constant of the solver was chosen, to judge the choices made on others.
namespace signorini::bench {

/// What is tried by hand: each method with each list, as far as it converges.
namespace kept_aside {

inline const std::vector<Overrides> methods{{"solver.method=monotone"},
                                            {"solver.method=tnnmg"},
                                            {"solver.method=monotone", "solver.transfer=kornhuber"},
                                            {"solver.method=pdas"}};
inline const std::vector<Overrides> lists{{},
                                          {"solver.pre=1", "solver.post=1"},
                                          {"solver.pre=3", "solver.post=3"},
                                          {"solver.relaxation=1"},
                                          {"solver.relaxation=1.1"},
                                          {"solver.relaxation=1.3"},
                                          {"solver.relaxation=1.5"},
                                          {"solver.smoother=symmetric", "solver.pre=1", "solver.post=1"},
                                          {"solver.cycle=F"},
                                          {"solver.coarse=pgs"},
                                          {"solver.krylov=false"},
                                          {"solver.coarsening=classical"},
                                          {"solver.coarsening=aggregation"}};

}  // namespace kept_aside

/// Prints the time of the default over that of the best settings picked by hand for ten matrices without a mesh.
/// @param only problems with this text in their names
void print_kept_aside_matrices(const std::string& only);

}  // namespace signorini::bench
