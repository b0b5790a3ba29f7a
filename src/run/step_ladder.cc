#include "run/step_ladder.h"

#include <algorithm>
#include <cmath>

namespace tourmaline::run {

namespace {

constexpr int halvings = 40;  // ticks in a unit, as a power of two
constexpr int smallest = 16;  // pair, likewise
constexpr double round_off = 1e-9;

bool is_multiple(double length, double unit) {
  const double times = length / unit;
  return std::abs(times - std::round(times)) <= round_off * times;
}

// Of which all lengths are multiples; 0 where there is none worth it.
double divisor(const std::vector<double> &lengths) {
  constexpr int finest = 64;
  const double shortest = *std::min_element(lengths.begin(), lengths.end());
  const double longest = *std::max_element(lengths.begin(), lengths.end());
  constexpr double most = 1 << 16;  // units in a stretch, so that ticks stay far from 2^63
  for (int parts = 1; parts <= finest && longest * parts <= most * shortest; ++parts)
    if (std::all_of(lengths.begin(), lengths.end(),
                    [&](double length) { return is_multiple(length, shortest / parts); }))
      return shortest / parts;
  return 0;
}

// Of the stretches, and of the longest pair if that can be: then it is as long as it may be.
double common_unit(std::vector<double> lengths, double longest_pair) {
  const double without = divisor(lengths);
  lengths.push_back(longest_pair);
  const double with = divisor(lengths);
  return with > 0 ? with : without;
}

// How far an error is from what is allowed, in halvings of the step; a tenth is kept as a reserve.
double halvings_for(double error) {
  return std::log2(std::sqrt(error) / 0.9);
}

}  // namespace

StepLadder::StepLadder(double end, double longest, const std::vector<double> &bends)
    : longest_(2 * longest), wanted_(2 * longest) {
  std::vector<double> times = bends, lengths;
  times.push_back(end);
  for (std::size_t i = 0; i < times.size(); ++i)
    lengths.push_back(times[i] - (i > 0 ? times[i - 1] : 0));
  const double common = common_unit(lengths, longest_);
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double unit = common > 0 ? common : lengths[i];
    stretches_.push_back({times[i] - lengths[i], times[i], std::ldexp(unit, -halvings),
                          static_cast<Ticks>(std::llround(lengths[i] / unit)) << halvings});
  }
}

// The largest power of two that is neither longer than wanted nor than what is left, and that the
// place is a multiple of: so no stretch ends in ever shorter pairs.
StepLadder::Ticks StepLadder::length() const {
  const double wanted = std::min(wanted_, longest_) * (1 + round_off) / stretch().tick;
  const int power = std::clamp(std::ilogb(wanted), smallest, 62);
  Ticks length = Ticks{1} << power;
  while (length > stretch().length - place_ || place_ % length != 0)
    length /= 2;
  return length;
}

double StepLadder::time(Ticks place) const {
  if (place == stretch().length)
    return stretch().end;
  return stretch().begin + static_cast<double>(place) * stretch().tick;
}

StepLadder::Pair StepLadder::pair() const {
  const Ticks half = length() / 2;
  return {static_cast<double>(half) * stretch().tick, time(place_ + half), time(place_ + 2 * half)};
}

// A pair that its place or the end of its stretch has cut short says little about longer ones.
void StepLadder::accept(double error) {
  constexpr double most = 3, any = 60;  // doublings
  const Ticks length = this->length();
  const double taken = static_cast<double>(length) * stretch().tick;
  const double doublings = error > 0 ? std::clamp(std::floor(-halvings_for(error)), 0., any) : any;
  const bool was_cut = 2 * taken <= std::min(wanted_, longest_) * (1 + round_off);
  const double grown = taken * std::exp2(std::min(doublings, most));
  wanted_ = std::min(
      longest_, was_cut ? std::min(taken * std::exp2(doublings), std::max(wanted_, grown)) : grown);
  place_ += length;
  if (place_ < stretch().length)
    return;
  ++stretch_;
  place_ = 0;
}

void StepLadder::reject(double error) {
  constexpr double most = 3;  // halvings; errors at the beginning fall more slowly
  const double needed = std::isfinite(error) ? halvings_for(error) : 2;
  const Ticks shorter = length() >> static_cast<int>(std::clamp(std::ceil(needed), 1., most));
  wanted_ = static_cast<double>(std::max(shorter, Ticks{1} << smallest)) * stretch().tick;
}

bool StepLadder::can_shrink() const {
  return length() > Ticks{1} << smallest;
}

void StepLadder::save(output::SavedNumbers &numbers) const {
  numbers.put("step ladder", {wanted_, static_cast<double>(stretch_), static_cast<double>(place_)});
}

void StepLadder::restore(const output::SavedNumbers &numbers) {
  const auto saved = numbers.get("step ladder", 3);
  wanted_ = saved[0];
  stretch_ = static_cast<std::size_t>(saved[1]);
  place_ = static_cast<Ticks>(saved[2]);
}

}  // namespace tourmaline::run
