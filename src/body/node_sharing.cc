#include "body/node_sharing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "parallel/ranks.h"

namespace tourmaline::body {

namespace {

// By node the first rank that has touched it.
std::vector<int> owners(const std::vector<bool> &touched) {
  const int ranks = parallel::n_ranks(), own = parallel::rank();
  std::vector<double> closeness(touched.size(), -ranks);  // the largest wins
  for (std::size_t i = 0; i < touched.size(); ++i)
    if (touched[i])
      closeness[i] = -own;
  parallel::largest(closeness);
  std::vector<int> owner(touched.size());
  std::transform(closeness.begin(), closeness.end(), owner.begin(),
                 [](double close) { return static_cast<int>(-close); });
  return owner;
}

}  // namespace

NodeSharing::NodeSharing(const std::vector<bool> &touched)
    : rank_(parallel::rank()), n_all_(touched.size()), owner_(owners(touched)) {}

NodeSharing::NodeSharing(const NodeSharing &whole, const std::vector<bool> &touched,
                         const std::vector<Node> &known)
    : rank_(whole.rank_), n_all_(whole.n_all_) {
  std::vector<bool> is_known(n_all_, false);
  is_known[0] = true;  // so that no rank is without a node, and the first one is the body's
  for (const Node node : known)
    is_known[node] = true;
  for (Node node = 0; node < n_all_; ++node) {
    if (!touched[node] && !is_known[node])
      continue;
    if (is_known[node])
      known_.push_back(static_cast<Node>(number_.size()));
    is_known_.push_back(is_known[node]);
    owner_.push_back(whole.owner_[node]);
    number_.push_back(node);
  }
  find_neighbours(touched);
}

// Every rank tells all others which of its nodes cells of several ranks touch. What two of them
// then have together both list alike.
void NodeSharing::find_neighbours(const std::vector<bool> &touched) {
  std::vector<double> times(touched.begin(), touched.end());
  parallel::sum(times);
  std::vector<std::uint32_t> mine;
  for (Node node = 0; node < number_.size(); ++node)
    if (!is_known_[node] && times[number_[node]] > 1)
      mine.push_back(number_[node]);
  const std::vector<std::uint32_t> sizes =
      parallel::joined(std::vector{static_cast<std::uint32_t>(mine.size())});
  const std::vector<std::uint32_t> all = parallel::joined(mine);
  auto next = all.begin();
  for (int rank = 0; rank < static_cast<int>(sizes.size()); ++rank) {
    const auto begin = std::exchange(next, next + sizes[static_cast<std::size_t>(rank)]);
    if (rank == rank_)
      continue;
    Neighbour with{rank, {}, {}};
    for (const Node node : nodes({begin, next}))
      if (is_own(node))
        with.own.push_back(node);
      else if (owner_[node] == rank)
        with.others.push_back(node);
    if (!with.own.empty() || !with.others.empty())
      neighbours_.push_back(std::move(with));
  }
}

std::vector<Node> NodeSharing::numbers(std::vector<Node> nodes) const {
  for (Node &node : nodes)
    node = number(node);
  return nodes;
}

std::optional<Node> NodeSharing::node(Node number) const {
  if (is_whole())
    return number;
  const auto found = std::lower_bound(number_.begin(), number_.end(), number);
  if (found == number_.end() || *found != number)
    return std::nullopt;
  return static_cast<Node>(found - number_.begin());
}

std::vector<Node> NodeSharing::nodes(const std::vector<Node> &numbers) const {
  std::vector<Node> here;
  for (const Node one : numbers)
    if (const std::optional<Node> found = node(one))
      here.push_back(*found);
  return here;
}

// Of each neighbour the entries of `sent` go there, and those that come are put with `two` to the
// entries of `received`, in the order of the ranks.
void NodeSharing::exchange(std::span<double> values, Of sent, Of received, Two two) const {
  const std::size_t of_node = values.size() / n_nodes();
  std::vector<parallel::Message> messages;
  for (const Neighbour &with : neighbours_) {
    parallel::Message &made = messages.emplace_back(
        parallel::Message{with.rank, {}, std::vector<double>(of_node * (with.*received).size())});
    for (const Node node : with.*sent)
      for (const double value : values.subspan(of_node * node, of_node))
        made.sent.push_back(value);
  }
  parallel::exchange(messages);
  for (std::size_t i = 0; i < messages.size(); ++i) {
    const double *next = messages[i].received.data();
    for (const Node node : neighbours_[i].*received)
      for (double &value : values.subspan(of_node * node, of_node))
        value = two(value, *next++);
  }
}

void NodeSharing::send_to_owners(std::span<double> shares, Two two) const {
  exchange(shares, &Neighbour::others, &Neighbour::own, two);
}

void NodeSharing::send_from_owners(std::span<double> values) const {
  exchange(values, &Neighbour::own, &Neighbour::others,
           [](double, double owners) { return owners; });
}

// Of nodes that all ranks know; `is_share`: whether this rank has something to it.
void NodeSharing::join_known(std::span<double> values, All all,
                             const std::function<bool(Node)> &is_share) const {
  const std::size_t of_node = values.size() / n_nodes();
  std::vector<double> known(of_node * known_.size(), 0.);
  for (std::size_t i = 0; i < known_.size(); ++i)
    if (is_share(known_[i]))
      std::copy_n(&values[of_node * known_[i]], of_node, &known[of_node * i]);
  all(known);
  for (std::size_t i = 0; i < known_.size(); ++i)
    std::copy_n(&known[of_node * i], of_node, &values[of_node * known_[i]]);
}

void NodeSharing::join(std::span<double> values, Two two, All all) const {
  if (is_whole())
    return all(values);
  send_to_owners(values, two);
  send_from_owners(values);
  join_known(values, all, [](Node) { return true; });
}

void NodeSharing::add_up(std::span<double> shares) const {
  join(
      shares, [](double a, double b) { return a + b; }, parallel::sum);
}

void NodeSharing::find_largest(std::span<double> sizes) const {
  join(
      sizes, [](double a, double b) { return std::max(a, b); }, parallel::largest);
}

void NodeSharing::take_from_owners(std::span<double> values) const {
  if (is_whole())
    return take_whole_from_owners(values);
  send_from_owners(values);
  join_known(values, parallel::sum, [this](Node node) { return is_own(node); });
}

// Each rank sends all that it owns to all others.
void NodeSharing::take_whole_from_owners(std::span<double> values) const {
  if (parallel::n_ranks() == 1)
    return;
  const std::size_t of_node = values.size() / n_nodes();
  std::vector<double> own;
  std::vector<std::size_t> next(static_cast<std::size_t>(parallel::n_ranks()), 0);
  for (Node node = 0; node < n_nodes(); ++node) {
    if (is_own(node))
      own.insert(own.end(), &values[of_node * node], &values[of_node * node] + of_node);
    next[static_cast<std::size_t>(owner_[node])] += of_node;
  }
  const std::vector<double> all = parallel::joined(own);
  std::exclusive_scan(next.begin(), next.end(), next.begin(), std::size_t{0});
  for (Node node = 0; node < n_nodes(); ++node) {
    std::size_t &from = next[static_cast<std::size_t>(owner_[node])];
    std::copy_n(&all[from], of_node, &values[of_node * node]);
    from += of_node;
  }
}

void NodeSharing::sum(std::span<double> values) const {
  if (!is_whole())
    parallel::sum(values);
}

double NodeSharing::sum(double value) const {
  sum(std::span(&value, 1));
  return value;
}

// MPI's maximum may lose what is not a number.
void NodeSharing::largest(std::span<double> values) const {
  if (is_whole())
    return;
  std::vector<double> all(values.begin(), values.end());
  for (const double value : values)
    all.push_back(std::isnan(value) ? 1 : 0);
  for (std::size_t i = 0; i < values.size(); ++i)
    if (std::isnan(all[i]))
      all[i] = 0;
  parallel::largest(all);
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = all[values.size() + i] > 0 ? std::numeric_limits<double>::quiet_NaN() : all[i];
}

double NodeSharing::largest(double value) const {
  largest(std::span(&value, 1));
  return value;
}

std::vector<double> NodeSharing::on_first(std::vector<double> part) const {
  if (is_whole())
    return part;
  const std::size_t of_node = part.size() / n_nodes();
  std::vector<double> own;
  std::vector<Node> own_numbers;
  for (Node node = 0; node < n_nodes(); ++node)
    if (is_own(node)) {
      own.insert(own.end(), &part[of_node * node], &part[of_node * node] + of_node);
      own_numbers.push_back(number_[node]);
    }
  const std::vector<double> all = parallel::joined_on_first(own);
  const std::vector<Node> numbers = parallel::joined_on_first(own_numbers);
  std::vector<double> whole(all.size());
  for (std::size_t i = 0; i < numbers.size(); ++i)
    std::copy_n(&all[of_node * i], of_node, &whole[of_node * numbers[i]]);
  return whole;
}

std::vector<double> NodeSharing::part_of(std::vector<double> whole) const {
  if (is_whole() || whole.empty())
    return whole;
  const std::size_t of_node = whole.size() / n_all_;
  std::vector<double> part;
  part.reserve(of_node * n_nodes());
  for (const Node number : number_)
    part.insert(part.end(), &whole[of_node * number], &whole[of_node * number] + of_node);
  return part;
}

}  // namespace tourmaline::body
