#include "condensation/symmetric_matrix.h"

namespace tourmaline::condensation {

using body::Fields;
using body::Node;
using body::unknown;

template <int dim>
SymmetricMatrix scaled_matrix(const body::Operator<dim> &op, double step,
                              const std::vector<int> &variable_of,
                              const std::vector<double> &scale) {
  const body::NodeGraph &graph = op.graph();
  SymmetricMatrix matrix;
  matrix.size = static_cast<int>(scale.size());
  const std::size_t entries =
      (graph.column.size() + graph.n_nodes()) / 2 * Fields<dim>::count * Fields<dim>::count;
  matrix.row.reserve(entries);
  matrix.column.reserve(entries);
  matrix.value.reserve(entries);
  for (Node i = 0; i < graph.n_nodes(); ++i)
    for (std::size_t e = graph.row[i]; e < graph.row[i + 1] && graph.column[e] <= i; ++e) {
      const auto block = op.step_block(e, step);
      for (int a = 0; a < Fields<dim>::count; ++a)
        for (int b = 0; b < Fields<dim>::count; ++b) {
          const int row = variable_of[unknown<dim>(i, a)];
          const int column = variable_of[unknown<dim>(graph.column[e], b)];
          if (row < 0 || column < 0 || column > row)
            continue;
          matrix.row.push_back(row + 1);
          matrix.column.push_back(column + 1);
          matrix.value.push_back(block(a, b) * scale[row] * scale[column]);
        }
    }
  return matrix;
}

template SymmetricMatrix scaled_matrix<2>(const body::Operator<2> &, double,
                                          const std::vector<int> &, const std::vector<double> &);
template SymmetricMatrix scaled_matrix<3>(const body::Operator<3> &, double,
                                          const std::vector<int> &, const std::vector<double> &);

}  // namespace tourmaline::condensation
