#include "solve/model.h"

#include <functional>

#include "body/conductors.h"
#include "mesh/distribute.h"
#include "parallel/available_memory.h"
#include "parallel/ranks.h"
#include "solve/held_by_mass.h"
#include "stopwatch.h"

namespace tourmaline::solve {

namespace {

std::vector<std::shared_ptr<double>> places_of_potentials(
    const std::vector<casefile::ContactCase> &contacts) {
  std::vector<std::shared_ptr<double>> places;
  for (const casefile::ContactCase &contact : contacts)
    places.push_back(contact.electric.circuit ? std::make_shared<double>(0.) : nullptr);
  return places;
}

std::vector<casefile::ContactCase> with_potentials(
    std::vector<casefile::ContactCase> contacts,
    const std::vector<std::shared_ptr<double>> &places) {
  for (std::size_t c = 0; c < contacts.size(); ++c)
    if (places[c])
      contacts[c].electric.foundation_potential = casefile::Formula::found(places[c]);
  return contacts;
}

template <int dim>
std::vector<body::Prescribed> prescribed_in(const body::Discretisation<dim> &body,
                                            const casefile::Case &asked) {
  std::vector<body::Prescribed> all =
      body::prescribed_unknowns(body, asked.boundaries, asked.electrodes);
  body::check_axis(body, asked, all);
  if (asked.time.is_static() || !asked.model.thermal)
    all = body::with_all<dim>(body::Fields<dim>::temperature, body, std::move(all));
  if (!asked.model.electric)
    all = body::with_all<dim>(body::Fields<dim>::potential, body, std::move(all));
  return all;
}

}  // namespace

template <int dim>
struct Model<dim>::Built {
  Built(const casefile::Case &asked, const std::function<mesh::Mesh<dim>()> &make_mesh,
        bool shares_nodes)
      : composition(asked),
        body(mesh::shared_out<dim>(make_mesh), asked.mesh.degree, body::geometry_of(asked)) {
    if (shares_nodes && parallel::n_ranks() > 1)
      body.share_nodes(body::nodes_with_conditions(body, asked));
    parallel::give_back_freed_memory();  // the mesh
    mesh_seconds = watch.lap();
  }

  Stopwatch watch;
  material::Composition<dim> composition;
  body::Discretisation<dim> body;
  double mesh_seconds = 0;
  Stopwatch since_mesh;
};

template <int dim>
Model<dim>::Model(const casefile::Case &asked_for, bool shares_nodes)
    : Model(asked_for, Built(
                           asked_for, [&] { return mesh::build<dim>(asked_for); }, shares_nodes)) {}

template <int dim>
Model<dim>::Model(const casefile::Case &asked_for, mesh::Mesh<dim> mesh)
    : Model(asked_for, Built(
                           asked_for, [&] { return std::move(mesh); }, false)) {}

template <int dim>
Model<dim>::Model(const casefile::Case &asked_for, Built built)
    : asked(asked_for),
      steps(asked.time),
      step(steps.size(1)),
      composition(std::move(built.composition)),
      body(std::move(built.body)),
      op(body, composition,
         asked.mesh.modes == "incompatible" ? body::Modes::incompatible : body::Modes::none),
      cells(body, composition, op.modes()),
      prescribed(prescribed_in(body, asked)),
      electrodes(body::electrode_nodes<dim>(prescribed, asked.electrodes)),
      found_potentials(places_of_potentials(asked.contacts)),
      laws(with_potentials(asked.contacts, found_potentials), step),
      linear_exchanges(laws.linear_exchanges()),
      loads(body, asked, step, composition.reference_temperature(), linear_exchanges),
      mesh_seconds(built.mesh_seconds) {
  body::check_conductors(body, composition, asked, prescribed);
  std::vector<std::vector<std::string>> boundaries;
  for (const casefile::ContactCase &contact : asked.contacts)
    boundaries.push_back(contact.on);
  contact::Interface<dim> found = contact::interface_of(body, boundaries);
  interface = std::move(found.nodes);
  contact_edges = std::move(found.edges);
  friction = laws.friction();
  for (const body::SurfaceExchange &exchange : linear_exchanges)
    if (exchange.field == body::SurfaceExchange::temperature) {
      op.add_exchange(body, exchange.on, exchange.coefficient);
      cells.add_exchange(exchange.on, exchange.coefficient);
    }
  add_capacitors();
  add_rate_forces();
  assemble_seconds = built.since_mesh.lap();
}

// Contact nodes have no mass, unless asked for: their inertia would make a chatter of every impact.
template <int dim>
void Model<dim>::add_rate_forces() {
  const bool is_dynamic = asked.time.is_dynamic();
  const bool is_damped = composition.is_damped() && !asked.time.is_static();
  if (!is_dynamic && !is_damped && asked.load.base_acceleration.empty())
    return;
  std::vector<bool> massless(body.n_nodes(), false);
  if (is_dynamic && asked.time.contact_mass == "redistributed")
    for (const contact::InterfaceNode<dim> &at : interface)
      massless[at.node] = true;
  body::RateForces<dim> forces(
      body, composition,
      asked.mesh.modes != "incompatible" ? body::Modes::none : body::Modes::incompatible,
      is_dynamic, massless);
  if (!is_damped)
    forces.drop_damping();
  op.set_rate_forces(std::move(forces));
  cells.add_rate_forces(op);
  if (is_dynamic && asked.time.contact_mass == "redistributed" && !interface.empty())
    require_mass_that_holds(*this);
}

template <int dim>
void Model<dim>::add_loads(double t, std::vector<double> &right_side) const {
  loads.integrate(t, right_side);
  for (int c = 0; c < static_cast<int>(asked.load.base_acceleration.size()); ++c) {
    const double acceleration = asked.load.base_acceleration[c].value({}, t);
    const std::vector<double> &masses = op.rate_forces()->node_masses();
    for (body::Node node = 0; node < masses.size(); ++node)
      right_side[body::unknown<dim>(node, c)] -= masses[node] * acceleration;
  }
}

template <int dim>
void Model<dim>::add_capacitors() {
  for (const body::SurfaceExchange &exchange : linear_exchanges)
    if (exchange.field == body::SurfaceExchange::potential) {
      op.add_capacitors(body, exchange.on, exchange.coefficient, exchange.factor);
      cells.add_capacitors(exchange.on, exchange.coefficient, exchange.factor);
    }
}

// Capacitors of a leak hold what crosses in one step. Others refer to the exchanges, which stay in
// their places.
template <int dim>
void Model<dim>::set_step(double k) {
  if (k == step)
    return;
  step = k;
  laws.set_step(k);
  for (body::SurfaceExchange &exchange : linear_exchanges)
    if (exchange.accumulates)
      exchange.factor = k;
  if (laws.remembers_charge()) {
    op.clear_capacitors();
    cells.clear_capacitors();
    add_capacitors();
  }
  loads = body::Loads<dim>(body, asked, k, composition.reference_temperature(), linear_exchanges);
}

template <int dim>
typename Model<dim>::Vector Model<dim>::foundation(const contact::InterfaceNode<dim> &at,
                                                   double time) const {
  const Vector3 moved = laws.of(at).foundation(at.point, time);
  return Vector::Map(moved.data());
}

template <int dim>
double Model<dim>::reach(const contact::InterfaceNode<dim> &at, double time) const {
  return laws.of(at).gap(at.point) + foundation(at, time).dot(at.normal);
}

template <int dim>
std::vector<double> Model<dim>::product(std::span<const double> x, bool by_cells) const {
  std::vector<double> product(x.size());
  if (by_cells)
    cells.multiply(step, x, product);
  else
    op.multiply(step, x, product);
  return product;
}

template <int dim>
body::FieldProducts Model<dim>::products_by_field(std::span<const double> x, bool by_cells) const {
  body::FieldProducts products;
  if (by_cells)
    cells.multiply_by_field(x, products);
  else
    op.multiply_by_field(x, products);
  return products;
}

template <int dim>
std::span<const double> Model<dim>::carried(std::span<const double> before, double time,
                                            std::vector<double> &carried) const {
  if (!laws.has_moving_foundation())
    return before;
  carried.assign(before.begin(), before.end());
  for (const contact::InterfaceNode<dim> &at : interface) {
    const Vector moved = foundation(at, time) - foundation(at, time_before(time));
    for (int c = 0; c < dim; ++c)
      carried[body::unknown<dim>(at.node, c)] += moved[c];
  }
  return carried;
}

template struct Model<2>;
template struct Model<3>;

}  // namespace tourmaline::solve
