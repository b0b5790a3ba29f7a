#pragma once

#include <vector>

#include "body/operator.h"

namespace tourmaline::condensation {

/// The lower triangle of a symmetric matrix by entries, numbered from 1 as MUMPS wants it; each
/// entry once. On several ranks it is the sum of what they hold.
struct SymmetricMatrix {
  int size = 0;
  std::vector<int> row, column;
  std::vector<double> value;
};

/// The operator of a step in the variables that are solved for: `variable_of` numbers them by
/// unknown of the body (-1: not among them), `scale` has a factor for the row and column of each,
/// and of any variables that follow.
template <int dim>
SymmetricMatrix scaled_matrix(const body::Operator<dim> &op, double step,
                              const std::vector<int> &variable_of,
                              const std::vector<double> &scale);

}  // namespace tourmaline::condensation
