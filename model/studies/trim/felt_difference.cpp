// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/speed-for-accuracy.md
#include "studies/trim/subject.hpp"

#include <time.h>

#include <algorithm>
#include <cmath>

#include "feltgate/largest.hpp"

namespace feltgate::trim {

namespace {

Loss loss(const Signal& reference, const Signal& other) {
  const std::vector<double>&of = reference.means(), &to = other.means();
  const std::size_t n = std::min(of.size(), to.size());
  double peak = reference.least(), worst = 0, squares = 0, error_squares = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double error = to[i] - of[i];
    peak = larger(peak, std::abs(of[i]));
    worst = larger(worst, std::abs(error));
    squares += of[i] * of[i];
    error_squares += error * error;
  }
  const double count = static_cast<double>(std::max<std::size_t>(n, 1));
  const double rms = std::max(reference.least(), std::sqrt(squares / count));
  return {worst / peak, std::sqrt(error_squares / count) / rms};
}

Loss loss(const std::vector<Signal>& reference, const std::vector<Signal>& other) {
  Loss most;
  for (std::size_t n = 0; n < reference.size(); ++n) {
    const Loss one = loss(reference[n], other.at(n));
    most = {larger(most.peak, one.peak), larger(most.rms, one.rms)};
  }
  return most;
}

}  // namespace

void Signal::add(Clock clocks, double value) {
  const double length = static_cast<double>(clocks);
  const double at = (static_cast<double>(now_) + 0.5 * length) / window_;
  const auto left = static_cast<std::size_t>(at);
  if (means_.size() < left + 2) means_.resize(left + 2, 0.0);
  const double share = value * length / window_;
  const double right = at - static_cast<double>(left);
  means_[left] += share * (1 - right);
  means_[left + 1] += share * right;
  now_ += clocks;
}

double Difference::worst() const {
  double most = 0;
  for (const Loss& l : {torque, position, force}) most = larger(most, larger(l.peak, l.rms));
  return most;
}

Difference compare(const Felt& reference, const Felt& other) {
  return {loss(reference.torque, other.torque), loss(reference.position, other.position),
          loss(reference.force, other.force)};
}

double thread_cpu_s() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

}  // namespace feltgate::trim
