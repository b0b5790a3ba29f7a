#include "run/recorder.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "body/derived.h"
#include "output/csv.h"
#include "parallel/ranks.h"
#include "run/contact_sums.h"
#include "run/step_check.h"
#include "solve/leaning.h"
#include "stopwatch.h"

namespace tourmaline::run {

namespace {

template <int dim>
using Vector = Eigen::Matrix<double, dim, 1>;

template <int dim>
Vector3 in_space(const Vector<dim> &v) {
  Vector3 plain{};
  std::copy(v.begin(), v.end(), plain.begin());
  return plain;
}

std::vector<double> coordinates_of(const std::vector<Vector3> &points) {
  std::vector<double> coordinates;
  for (const Vector3 &point : points)
    coordinates.insert(coordinates.end(), point.begin(), point.end());
  return coordinates;
}

std::vector<Vector3> places_of(const std::vector<double> &coordinates) {
  std::vector<Vector3> points;
  for (std::size_t i = 0; i < coordinates.size(); i += 3)
    points.push_back({coordinates[i], coordinates[i + 1], coordinates[i + 2]});
  return points;
}

template <int dim>
Vector<dim> displacement(std::span<const double> state, body::Node node) {
  return Eigen::Map<const Vector<dim>>(&state[body::unknown<dim>(node, 0)]);
}

template <int dim>
Vector<dim> tangential(const Vector<dim> &v, const Vector<dim> &normal) {
  return v - v.dot(normal) * normal;
}

}  // namespace

template <int dim>
Recorder<dim>::Recorder(const solve::Model<dim> &model, output::ResultFolder &folder)
    : model_(model),
      folder_(folder),
      judgement_(solve::resisted_by_contact_alone(model)),
      probes_(model) {
  for (std::size_t c = 0; c < model.laws.size(); ++c)
    linear_.push_back({model.laws[c].linear(contact::Crossing::heat),
                       model.laws[c].linear(contact::Crossing::charge)});
}

template <int dim>
void Recorder<dim>::initial(std::span<const double> state, const solve::RateRecord &rates) {
  Stopwatch watch;
  balance_.emplace(model_, state);
  if (model_.asked.time.is_dynamic())
    balance_->begin_motion(rates);
  put_boundaries();
  parallel::together([&] { StepCheck(0, 0).state(dim, model_.body.points(), state); });
  if (has_fields(0))
    put_fields(0, state, checked_fields(0, state));
  seconds_ += watch.lap();
}

template <int dim>
void Recorder<dim>::put_boundaries() {
  const std::vector<output::NamedBoundary> boundaries = model_.body.boundaries();
  parallel::on_first([&] {
    folder_.put_boundaries(boundaries);
    if (model_.asked.contacts.empty())
      return;
    std::vector<std::string> names;
    for (const casefile::ContactCase &contact : model_.asked.contacts)
      names.insert(names.end(), contact.on.begin(), contact.on.end());
    std::vector<std::uint32_t> nodes;
    for (const contact::InterfaceNode<dim> &at : model_.interface)
      nodes.push_back(model_.sharing().number(at.node));
    contact_facets_ = output::contact_facets(boundaries, names, nodes);
  });
}

template <int dim>
void Recorder<dim>::restore(std::span<const double> state, const output::SavedNumbers &numbers) {
  put_boundaries();
  balance_.emplace(model_, state);
  balance_->restore(numbers);
  judgement_.restore(numbers);
  seconds_ = numbers.get("output seconds", 1)[0];
}

template <int dim>
void Recorder<dim>::save(output::SavedNumbers &numbers) const {
  balance_->save(numbers);
  judgement_.save(numbers);
  numbers.put("output seconds", {seconds_});
}

template <int dim>
output::HistoryRow Recorder<dim>::step(int n, const solve::StepOutcome &outcome,
                                       std::span<const double> loads,
                                       std::span<const double> before,
                                       std::span<const double> state, const solve::Route &route,
                                       const std::function<solve::Accuracy()> &measure) {
  Stopwatch watch;
  const double time = model_.time(n);
  const StepCheck check(n, time);
  parallel::together([&] { check.state(dim, model_.body.points(), state); });
  output::HistoryRow row;
  row.step = n;
  row.time = time;
  row.newton_iterations = outcome.newton_iterations;
  row.residual = outcome.residual;
  row.stick = std::count(outcome.status.begin(), outcome.status.end(), ContactStatus::stick);
  row.slip = std::count(outcome.status.begin(), outcome.status.end(), ContactStatus::slip);
  row.open = std::count(outcome.status.begin(), outcome.status.end(), ContactStatus::open);
  std::vector<output::ContactRow> rows;
  if (has_contact())
    rows = contact_rows(n, outcome, before, state);
  check.contact(rows);
  row.quantities = balance_->step(time, loads, outcome, state, route.is_refined());
  if (outcome.has_stages())
    row.quantities.emplace_back("contact_stage", static_cast<double>(outcome.stage));
  for (const output::Extreme &e : extremes(state)) {
    row.quantities.emplace_back("min_" + e.field, e.minimum);
    row.quantities.emplace_back("max_" + e.field, e.maximum);
  }
  add_contact_extremes(model_, rows, row.quantities);
  add_contact_sums(model_, outcome, time, row.quantities);
  check.quantities(row.quantities);
  check.quantities({{"residual", row.residual}});
  judgement_.step(n, time, balance_->judged(), measure);
  judgement_.forward_error(n, time, route.accuracy_so_far());
  const std::vector<output::ProbeRows> probes = probes_.rows(time, balance_->passages(), state);
  output::CellFields cells;
  if (has_fields(n))
    cells = checked_fields(n, state);
  parallel::on_first([&] {
    if (has_contact())
      folder_.put_contact(n, time, rows);
    if (has_contact() && has_fields(n))
      folder_.put_contact_fields(n, time, contact_facets_, rows);
    for (const output::ProbeRows &probe : probes)
      folder_.put_probe(n, time, probe);
    folder_.put_history(row);
  });
  if (has_fields(n))
    put_fields(n, state, cells);
  seconds_ += watch.lap();
  return row;
}

template <int dim>
output::CellFields Recorder<dim>::checked_fields(int n, std::span<const double> state) {
  prepare_fields();
  output::CellFields cells;
  parallel::together([&] {
    cells = body::derived_fields(model_.body, model_.composition, state);
    StepCheck(n, model_.time(n)).fields(grid_, cells);
  });
  return cells;
}

template <int dim>
void Recorder<dim>::finish(std::span<const double> state) {
  Stopwatch watch;
  const body::NodeSharing &sharing = model_.sharing();
  std::vector<double> unknowns;
  std::vector<Vector3> places;
  if (!sharing.is_whole()) {
    unknowns = sharing.on_first({state.begin(), state.end()});
    places = places_of(sharing.on_first(coordinates_of(model_.body.points())));
  }
  parallel::on_first([&] {
    folder_.finish();  // first, so that a full disk costs no row of the tables
    std::vector<body::Node> all(sharing.n_all());
    std::iota(all.begin(), all.end(), body::Node{0});
    folder_.put_nodes(places.empty() ? model_.body.points() : places,
                      point_fields(unknowns.empty() ? state : unknowns, all));
  });
  seconds_ += watch.lap();
}

// The grid of the files has a point for each region that a node belongs to, as stresses jump there.
template <int dim>
void Recorder<dim>::prepare_fields() {
  if (recovery_)
    return;
  recovery_.emplace(model_.body);
  const body::RegionalNodes &regional = recovery_->nodes();
  grid_ = model_.body.grid();
  for (std::size_t i = grid_.points.size(); i < regional.size(); ++i)
    grid_.points.push_back(grid_.points[regional.node(i)]);
  for (std::size_t i = 0; i < grid_.connectivity.size(); ++i)
    grid_.connectivity[i] = regional.number(grid_.connectivity[i],
                                            regional.regions_of_cells()[i / grid_.nodes_per_cell]);
  nodes_ = output::keep_used_points(grid_);
}

template <int dim>
void Recorder<dim>::put_fields(int n, std::span<const double> state,
                               const output::CellFields &cells) {
  const std::vector<output::SymmetricTensor> stress =
      (*recovery_)(model_.composition, state, cells.stress);
  parallel::together([&] {
    std::vector<body::Node> nodes;
    for (const std::uint32_t number : nodes_)
      nodes.push_back(recovery_->nodes().node(number));
    output::PointFields points = point_fields(state, nodes);
    for (const std::uint32_t number : nodes_) {
      points.stress.push_back(stress[number]);
      points.principal_stress.push_back(body::principal_stresses(stress[number]));
      points.von_mises.push_back(body::von_mises(stress[number]));
    }
    folder_.put_fields(n, model_.time(n), grid_, points, cells);
  });
  parallel::on_first([&] { folder_.list_fields(n, model_.time(n)); });
}

template <int dim>
output::PointFields Recorder<dim>::point_fields(std::span<const double> state,
                                                std::span<const body::Node> nodes) const {
  output::PointFields fields;
  for (const body::Node node : nodes) {
    fields.displacement.push_back(in_space<dim>(displacement<dim>(state, node)));
    fields.potential.push_back(state[body::unknown<dim>(node, body::Fields<dim>::potential)]);
    fields.temperature.push_back(state[body::unknown<dim>(node, body::Fields<dim>::temperature)]);
  }
  return fields;
}

// What crosses by place alone, and what does by the contact's state, `flow` by node.
template <int dim>
double Recorder<dim>::flux(contact::Crossing what, std::size_t i, double value, double time,
                           const Eigen::VectorXd &flow) const {
  const contact::InterfaceNode<dim> &at = model_.interface[i];
  const double by_state = flow.size() > 0 ? flow[static_cast<Eigen::Index>(i)] / at.weight : 0;
  const auto &linear = linear_[at.contact][what == contact::Crossing::heat ? 0 : 1];
  const double factor = linear && linear->accumulates ? model_.step : 1;
  const double coefficient = linear ? factor * linear->coefficient.value(at.point, 0) : 0;
  if (coefficient == 0)
    return by_state;
  return coefficient * (value - linear->outside.value(at.point, time)) + by_state;
}

template <int dim>
double Recorder<dim>::charge_flux(const solve::StepOutcome &outcome, std::size_t i, double phi,
                                  double time) const {
  const double before =
      outcome.leaked_flux.size() > 0 ? outcome.leaked_flux[static_cast<Eigen::Index>(i)] : 0;
  return before + flux(contact::Crossing::charge, i, phi, time, outcome.charge_flow);
}

template <int dim>
std::vector<output::ContactRow> Recorder<dim>::contact_rows(int n,
                                                            const solve::StepOutcome &outcome,
                                                            std::span<const double> before,
                                                            std::span<const double> state) const {
  std::vector<output::ContactRow> rows;
  std::vector<double> storage;
  const std::span<const double> carried = model_.carried(before, model_.time(n), storage);
  for (std::size_t i = 0; i < model_.interface.size(); ++i) {
    const contact::InterfaceNode<dim> &at = model_.interface[i];
    // Tractions are the multipliers: nodal force over lumped weight.
    const Vector<dim> traction =
        outcome.contact_forces.segment<dim>(dim * static_cast<Eigen::Index>(i)) / at.weight;
    const Vector<dim> u = displacement<dim>(state, at.node);
    const Vector<dim> to_foundation = u - model_.foundation(at, model_.time(n));
    const Vector<dim> change = u - displacement<dim>(carried, at.node);
    const double theta = state[body::unknown<dim>(at.node, body::Fields<dim>::temperature)],
                 phi = state[body::unknown<dim>(at.node, body::Fields<dim>::potential)];
    rows.push_back({at.point,
                    traction.dot(at.normal),
                    in_space<dim>(tangential<dim>(traction, at.normal)),
                    u.dot(at.normal),
                    in_space<dim>(tangential<dim>(to_foundation, at.normal)),
                    tangential<dim>(change, at.normal).norm() / model_.step,
                    outcome.status[i],
                    theta,
                    phi,
                    flux(contact::Crossing::heat, i, theta, model_.time(n), outcome.heat_flow),
                    model_.laws.of(at).gap(at.point) - to_foundation.dot(at.normal),
                    charge_flux(outcome, i, phi, model_.time(n)),
                    {},
                    name_of_several(model_.asked.contacts, at.contact),
                    static_cast<std::int32_t>(at.contact)});
    const auto put = [&](const char *name, const Eigen::VectorXd &by_node) {
      if (by_node.size() > 0)
        rows.back().quantities.emplace_back(name, by_node[static_cast<Eigen::Index>(i)]);
    };
    if (!model_.laws.has_own_friction())  // of which nobody knows one
      put("friction_bound", outcome.friction_bound);
    put("accumulated_slip", outcome.accumulated_slip);
  }
  return rows;
}

namespace {

// A node of this rank and its value; made that of the least value of all ranks, and of the first
// node that has it: where that stands.
template <int dim>
Vector3 find_least(const body::Discretisation<dim> &body, body::Node node, double &value) {
  const body::NodeSharing &sharing = body.sharing();
  const double of_all = -sharing.largest(-value),
               number =
                   value == of_all ? sharing.number(node) : static_cast<double>(sharing.n_all());
  value = of_all;
  const auto here = sharing.node(static_cast<body::Node>(-sharing.largest(-number)));
  Vector3 place{};
  if (here && sharing.counts(*here))
    place = body.points()[*here];
  sharing.sum(place);
  return place;
}

template <int dim>
output::Extreme extreme_of(const std::string &field, const body::Discretisation<dim> &body,
                           const std::function<double(body::Node)> &value) {
  body::Node lowest = 0, highest = 0;
  double least = value(0), less_the_greatest = -least;
  for (body::Node node = 1; node < body.n_nodes(); ++node) {
    const double v = value(node);
    if (v < least) {
      least = v;
      lowest = node;
    }
    if (-v < less_the_greatest) {
      less_the_greatest = -v;
      highest = node;
    }
  }
  output::Extreme found{field};
  found.at_minimum = find_least(body, lowest, least);
  found.at_maximum = find_least(body, highest, less_the_greatest);
  found.minimum = least;
  found.maximum = -less_the_greatest;
  return found;
}

}  // namespace

template <int dim>
std::vector<output::Extreme> Recorder<dim>::extremes(std::span<const double> state) const {
  using Value = std::function<double(body::Node)>;
  const auto component = [&](int c) {
    return [&state, c](body::Node node) { return state[body::unknown<dim>(node, c)]; };
  };
  const std::vector<std::pair<std::string, Value>> fields{
      {"displacement", [&](body::Node node) { return displacement<dim>(state, node).norm(); }},
      {"potential", component(body::Fields<dim>::potential)},
      {"temperature", component(body::Fields<dim>::temperature)}};
  std::vector<output::Extreme> all;
  for (const auto &[name, value] : fields)
    if (model_.asked.model.has(name))
      all.push_back(extreme_of(name, model_.body, value));
  return all;
}

template class Recorder<2>;
template class Recorder<3>;

}  // namespace tourmaline::run
