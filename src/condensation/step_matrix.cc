#include "condensation/step_matrix.h"

#include <utility>

namespace tourmaline::condensation {

using body::Fields;
using body::Node;

namespace {

// The groups of each node, and of each group its node.
template <int dim>
class Groups {
 public:
  Groups(GroupedMatrix &matrix, const std::vector<Node> &node_at,
         const std::vector<std::size_t> &unknown_of, const std::vector<bool> &is_kept)
      : matrix_(matrix), is_kept_(is_kept), of_node_(node_at.size(), {-1, -1}) {
    first_of_.assign(node_at.size() + 1, 0);
    for (const std::size_t unknown : unknown_of)
      ++first_of_[unknown / Fields<dim>::count + 1];
    for (std::size_t i = 0; i < node_at.size(); ++i)
      first_of_[i + 1] += first_of_[i];
    for (const Node node : node_at)
      of_node_[node].first = add(node, false);
    matrix.kept = -matrix.size();
    for (Node node = 0; node < node_at.size(); ++node)
      of_node_[node].second = add(node, true);
    matrix.kept += matrix.size();
  }

  Node node(int group) const { return node_of_[group]; }
  std::pair<int, int> of(Node node) const { return of_node_[node]; }

 private:
  // Variables are numbered node by node. -1: the node has none.
  int add(Node node, bool kept) {
    for (int v = first_of_[node]; v < first_of_[node + std::size_t{1}]; ++v)
      if (is_kept_[v] == kept)
        matrix_.variables.push_back(v);
    const int end = static_cast<int>(matrix_.variables.size());
    if (end == matrix_.first.back())
      return -1;
    matrix_.first.push_back(end);
    node_of_.push_back(node);
    return matrix_.size() - 1;
  }

  GroupedMatrix &matrix_;
  const std::vector<bool> &is_kept_;
  std::vector<std::pair<int, int>> of_node_;  // not kept, kept
  std::vector<int> first_of_;                 // variable of each node
  std::vector<Node> node_of_;
};

}  // namespace

template <int dim>
GroupedMatrix step_matrix(const body::Operator<dim> &op, double step,
                          const std::vector<Node> &node_at,
                          const std::vector<std::size_t> &unknown_of,
                          const std::vector<double> &scale, const std::vector<bool> &is_kept) {
  GroupedMatrix matrix;
  const Groups<dim> groups(matrix, node_at, unknown_of, is_kept);
  std::vector<std::size_t> entry_of;  // of the node graph, by neighbour
  for (int g = 0; g < matrix.size(); ++g) {
    const Node node = groups.node(g);
    for (std::size_t e = op.graph().row[node]; e < op.graph().row[node + std::size_t{1}]; ++e) {
      const auto [inside, kept] = groups.of(op.graph().column[e]);
      for (const int other : {inside, kept})
        if (other >= 0) {
          matrix.neighbour.push_back(other);
          entry_of.push_back(e);
        }
    }
    matrix.row.push_back(matrix.neighbour.size());
  }
  matrix.block = [&op, &unknown_of, &scale, step, entry_of = std::move(entry_of)](
                     const GroupedMatrix &m, int group, std::size_t e, double *values) {
    const auto block = op.step_block(entry_of[e], step);
    const int other = m.neighbour[e];
    for (int i = m.first[group]; i < m.first[group + 1]; ++i)
      for (int j = m.first[other]; j < m.first[other + 1]; ++j) {
        const int row = m.variables[i], column = m.variables[j];
        *values++ = block(static_cast<int>(unknown_of[row] % Fields<dim>::count),
                          static_cast<int>(unknown_of[column] % Fields<dim>::count)) *
                    scale[row] * scale[column];
      }
  };
  return matrix;
}

template GroupedMatrix step_matrix<2>(const body::Operator<2> &, double, const std::vector<Node> &,
                                      const std::vector<std::size_t> &, const std::vector<double> &,
                                      const std::vector<bool> &);
template GroupedMatrix step_matrix<3>(const body::Operator<3> &, double, const std::vector<Node> &,
                                      const std::vector<std::size_t> &, const std::vector<double> &,
                                      const std::vector<bool> &);

}  // namespace tourmaline::condensation
