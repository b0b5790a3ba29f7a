#pragma once

#include "random.h"
#include "sample.h"

namespace tourmaline::verified {

/// What a relation asks of its cases.
struct Wish {
  /// No friction, or so much that all that can stick does; nothing crosses by the contact's state.
  bool linear = false;
  bool resistors = true;  ///< electrodes may have resistors, which the condensed route alone takes
};

/// A small case whose strains, fields and temperatures are such that every coupling matters, and
/// where there is friction some points stick and others slip.
Sample random_sample(Random &random, const Wish &wish = {});

/// The same with other loads.
Sample with_other_loads(Sample sample, Random &random);

}  // namespace tourmaline::verified
