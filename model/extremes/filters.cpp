#include "extremes/case.hpp"
namespace feltgate::extremes {
std::vector<Case> filter_cases() { return {}; }
std::vector<Case> observer_cases() { return {}; }
std::vector<Case> scene_cases() { return {}; }
std::vector<Case> loop_cases() { return {}; }
}  // namespace feltgate::extremes
