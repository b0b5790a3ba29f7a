#include "run/start_state.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <utility>

#include "body/interpolation.h"
#include "case/electrodes.h"
#include "mesh/distribute.h"
#include "mesh/mesh.h"
#include "parallel/ranks.h"
#include "run/recorded_run.h"
#include "solve/electrodes.h"
#include "tourmaline/case/case.h"
#include "tourmaline/case/reader.h"
#include "tourmaline/error.h"
#include "tourmaline/mesh/gmsh.h"

namespace tourmaline::run {

namespace fs = std::filesystem;
using body::Fields;
using body::unknown;
using casefile::InitialCase;

namespace {

// How far apart two numbers of one coordinate are at most, and how far a place may lie outside of
// the other mesh, where both approximate one curved boundary; of the body's size, and of its extent
// where it is thinnest.
constexpr double same_place = 1e-12, near_boundary = 1e-3, of_thickness = 1e-2;
// How far two charges or voltages that are one differ at most: by the digits of tables and
// solutions.
constexpr double same_charge = 1e-6, same_value = 1e-9;

// Along each axis, in ascending order [m].
template <int dim>
std::vector<double> extents_of(const std::vector<Vector3> &points) {
  std::vector<double> extents;
  for (std::size_t i = 0; i < dim; ++i) {
    const auto [low, high] =
        std::minmax_element(points.begin(), points.end(),
                            [&](const Vector3 &a, const Vector3 &b) { return a[i] < b[i]; });
    extents.push_back((*high)[i] - (*low)[i]);
  }
  std::ranges::sort(extents);
  return extents;
}

template <int dim>
double size_of(const std::vector<Vector3> &points) {
  return extents_of<dim>(points).back();
}

// A thin body has no curved boundary that would need as much of its length.
template <int dim>
double near_boundary_of(const std::vector<Vector3> &points) {
  const std::vector<double> extents = extents_of<dim>(points);
  return std::min(near_boundary * extents.back(), of_thickness * extents.front());
}

double distance(const Vector3 &a, const Vector3 &b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

// Behind the nodes a field file has further points where regions meet.
template <int dim>
bool are_nodes_of(const RecordedState &from, const std::vector<Vector3> &nodes) {
  const double apart = same_place * size_of<dim>(nodes);
  return nodes.size() <= from.points.size() &&
         std::equal(nodes.begin(), nodes.end(), from.points.begin(),
                    [&](const Vector3 &a, const Vector3 &b) { return distance(a, b) <= apart; });
}

template <int dim>
body::Discretisation<dim> mesh_of(const InitialCase &initial, const RecordedState &from) {
  try {
    const casefile::Case other =
        casefile::read_file(fs::path(*initial.from) / "resolved.toml", {}, mesh::read_mesh_file);
    body::Discretisation<dim> body(mesh::shared_out<dim>([&] { return mesh::build<dim>(other); }),
                                   other.mesh.degree, body::geometry_of(other));
    if (are_nodes_of<dim>(from, body.points()))
      return body;
  } catch (const CaseError &error) {
    fail_from(initial,
              fmt::format("its mesh, from which the state is interpolated onto the one of this "
                          "case, cannot be made again: {}",
                          error.what()));
  }
  fail_from(initial,
            "the mesh that its case names is another one now than the run had; the state can be "
            "interpolated from that one only");
}

template <int dim>
[[noreturn]] void fail_outside(const InitialCase &initial, const char *body, const char *other,
                               const Vector3 &place, double away) {
  std::string words = fmt::format("{:g}, {:g}", place[0], place[1]);
  if (dim == 3)
    words += fmt::format(", {:g}", place[2]);
  fail_from(initial,
            fmt::format("the body of {} does not reach [{}] m, a place of {}, by {:.3g} m; "
                        "both must be one body",
                        body, words, other, away));
}

// A part of the body would have been cut off, and what held it with it.
template <int dim>
void require_whole(const solve::Model<dim> &model, const RecordedState &from) {
  constexpr double coarser = 10;  // facets of a coarse mesh leave out more of a circle
  const double far = coarser * near_boundary_of<dim>(from.points);
  const std::vector<body::Interpolation> found = body::nearest_places(model.body, from.points);
  for (std::size_t i = 0; i < found.size(); ++i)
    if (found[i].distance > far)
      fail_outside<dim>(model.asked.initial, "this case", "that run's", from.points[i],
                        found[i].distance);
}

// Places a little outside of the other mesh have the values of the nearest ones in it.
template <int dim>
std::vector<double> interpolated(const InitialCase &initial, const RecordedState &from,
                                 const std::vector<Vector3> &points) {
  const body::Discretisation<dim> other = mesh_of<dim>(initial, from);
  std::vector<body::Interpolation> found = body::nearest_places(other, points);
  const double far = near_boundary_of<dim>(from.points);
  std::vector<Vector3> nearby;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (found[i].distance > far)
      fail_outside<dim>(initial, "that run", "this one", points[i], found[i].distance);
    if (found[i].distance > 0)
      nearby.push_back(found[i].place);
  }
  const std::vector<body::Interpolation> instead = body::nearest_places(other, nearby);
  auto next = instead.begin();
  for (body::Interpolation &one : found)
    if (one.distance > 0)
      one = *next++;
  std::vector<double> state(points.size() * Fields<dim>::count);
  for (std::size_t i = 0; i < points.size(); ++i)
    for (int c = 0; c < Fields<dim>::count; ++c)
      state[unknown<dim>(static_cast<body::Node>(i), c)] =
          found[i].template value<dim>(from.unknowns, c);
  return state;
}

// Of the whole body, whatever this rank has of it.
std::vector<Vector3> all_points(const std::vector<Vector3> &points,
                                const body::NodeSharing &sharing) {
  if (sharing.is_whole())
    return points;
  std::vector<double> coordinates;
  for (const Vector3 &point : points)
    coordinates.insert(coordinates.end(), point.begin(), point.end());
  coordinates = sharing.on_first(std::move(coordinates));
  parallel::from_first(coordinates);
  std::vector<Vector3> all(sharing.n_all());
  for (std::size_t i = 0; i < all.size(); ++i)
    std::copy_n(&coordinates[3 * i], 3, all[i].begin());
  return all;
}

template <int dim>
double largest(const std::vector<double> &state, int component) {
  double most = 0;
  for (std::size_t i = static_cast<std::size_t>(component); i < state.size();
       i += Fields<dim>::count)
    most = std::max(most, std::abs(state[i]));
  return most;
}

// What the files of a run do not have.
template <int dim>
void require_recorded(const solve::Model<dim> &model, const casefile::Case &other) {
  const InitialCase &initial = model.asked.initial;
  if (model.laws.remembers_slip())
    fail_from(initial,
              "is not available with friction that weakens with the accumulated slip, which the "
              "files of a run do not have for another one; have both in one run");
  if (model.laws.remembers_charge())
    fail_from(initial,
              "is not available with a contact through which charge leaks, as what has crossed "
              "before would be forgotten; have both in one run");
  for (const casefile::ContactCase &contact : model.asked.contacts)
    if (contact.electric.circuit)
      fail_from(initial,
                "is not available with a foundation that conducts (contact.electric.circuit), "
                "as its charge would be forgotten; have both in one run");
  if (other.time.is_dynamic() && model.asked.time.is_dynamic() && initial.velocity.empty())
    fail_from(initial,
              "that run was dynamic, and files have no velocities; give initial.velocity, "
              "[0, ...] where it had come to rest");
}

template <int dim>
void require_one_theory(const solve::Model<dim> &model, const casefile::Case &other) {
  const InitialCase &initial = model.asked.initial;
  const casefile::Case &asked = model.asked;
  if (other.model.plane != asked.model.plane && dim == 2)
    fail_from(initial, fmt::format("that run has model.plane = \"{}\", this one \"{}\"",
                                   other.model.plane, asked.model.plane));
  const double there = material::Composition<dim>(other).reference_temperature(),
               here = model.composition.reference_temperature();
  if (other.model.thermal && asked.model.thermal && there != here)
    fail_from(initial,
              fmt::format("its temperatures are differences to {} K, those of this case to {} K",
                          there, here));
}

template <int dim>
void require_unknowns(const casefile::Case &asked, const std::vector<double> &state) {
  const double volts = largest<dim>(state, Fields<dim>::potential),
               warmth = largest<dim>(state, Fields<dim>::temperature);
  if (!asked.model.electric && volts > 0)
    fail_from(asked.initial,
              fmt::format("that run has potentials of up to {:g} V, and this case has "
                          "model.electric = false",
                          volts));
  if (!asked.model.thermal && warmth > 0)
    fail_from(asked.initial,
              fmt::format("that run has temperatures of up to {:g} K, and this case has "
                          "model.thermal = false",
                          warmth));
  if (asked.time.is_static() && warmth > 0)
    fail_from(
        asked.initial,
        fmt::format("that run has temperatures of up to {:g} K, and those of a static case are its "
                    "own steady ones; take time.regime = \"quasistatic\"",
                    warmth));
}

// An electrode has one potential, which interpolation keeps but for round-off.
template <int dim>
void level_electrodes(const solve::Model<dim> &model, std::vector<double> &state) {
  constexpr double round_off = 1e-9;
  const double size = model.sharing().largest(largest<dim>(state, Fields<dim>::potential));
  for (std::size_t e = 0; e < model.electrodes.size(); ++e) {
    const std::vector<body::Node> &nodes = model.electrodes[e];
    const double voltage = state[unknown<dim>(nodes.front(), Fields<dim>::potential)];
    for (const body::Node node : nodes) {
      double &potential = state[unknown<dim>(node, Fields<dim>::potential)];
      if (std::abs(potential - voltage) > round_off * size)
        fail_from(model.asked.initial,
                  fmt::format(
                      "electrode \"{}\" has one potential, and the places it covers had {:g} V "
                      "and {:g} V in that run; both must have the same electrodes, and on another "
                      "mesh none that touches another",
                      model.asked.electrodes[e].name, voltage, potential));
      potential = voltage;
    }
  }
}

// Where the other end of the electrode's capacitor stands, if that is a given voltage.
double source_of(const casefile::ElectrodeCase &electrode, double time) {
  const bool has_source = electrode.capacitor && !electrode.to && electrode.voltage;
  return has_source ? electrode.voltage->value({}, time) : 0;
}

// A capacitor's charge is that of both its ends.
void require_same_source(const InitialCase &initial, const casefile::ElectrodeCase &here,
                         const casefile::Case &other, const RecordedRow &last) {
  if (!here.capacitor || here.to)
    return;
  const auto there = std::ranges::find(other.electrodes, here.name, &casefile::ElectrodeCase::name);
  const std::optional<double> time = last.value("time");
  const bool was_on = time || other.time.is_dynamic() || other.initial.from;
  const double before = there != other.electrodes.end() && was_on
                            ? source_of(*there, time.value_or(0))
                            : 0,
               now = source_of(here, 0);
  if (std::abs(now - before) > same_value * std::max(std::abs(now), std::abs(before)))
    fail_from(
        initial,
        fmt::format("the other end of the capacitor at electrode \"{}\" was at {:g} V in that "
                    "run, and is at {:g} V here at t = 0; the capacitor keeps its charge, so it "
                    "must begin where it was (`voltage` may change behind t = 0, as in \"{:g} + "
                    "100*(t > 0)\")",
                    here.name, before, now, before));
}

// Of what the charge on an electrode at those nodes is summed up from [C].
template <int dim>
double size_of_terms(const solve::Model<dim> &model, const std::vector<body::Node> &nodes,
                     const std::vector<double> &products, const std::vector<double> &state) {
  std::vector<double> volt(state.size(), 0.);
  for (const body::Node node : nodes)
    volt[unknown<dim>(node, Fields<dim>::potential)] = 1;
  const std::vector<double> of_volt = model.product(volt, false);
  const double highest = model.sharing().largest(largest<dim>(state, Fields<dim>::potential));
  double size = 0;
  for (const body::Node node : nodes) {
    const std::size_t i = unknown<dim>(node, Fields<dim>::potential);
    size += std::abs(products[i]) + highest * std::abs(of_volt[i]);
  }
  return size;
}

// By electrode, of those that keep theirs.
std::map<std::string, double> charges_of(const casefile::Case &asked, const RecordedRow &last) {
  std::map<std::string, double> charges;
  for (const casefile::ElectrodeCase &electrode : asked.electrodes)
    if (const auto recorded = last.value(fmt::format("electrode_{}_charge", electrode.name));
        recorded && !electrode.is_driven())
      charges.emplace(electrode.name, *recorded);
  return charges;
}

// Cells of other shapes may have the same nodes. Of a mesh from a file its folder does not tell
// all.
bool have_same_cells(const casefile::MeshCase &one, const casefile::MeshCase &other) {
  return one.degree == other.degree && one.modes == other.modes &&
         (one.file || other.file || shape_of(one) == shape_of(other));
}

// On one mesh electrodes that keep their charge begin with that of the state, by this case's
// constants and its loads at t = 0.
template <int dim>
void require_same_charges(const solve::Model<dim> &model, const std::vector<double> &state,
                          const std::map<std::string, double> &kept) {
  const Eigen::VectorXd charges = solve::settled_charges<dim>(model, state);
  const std::vector<double> products = model.product(state, false);
  for (std::size_t e = 0; e < model.electrodes.size(); ++e) {
    const casefile::ElectrodeCase &electrode = model.asked.electrodes[e];
    const auto recorded = kept.find(electrode.name);
    if (electrode.charge || recorded == kept.end())
      continue;
    const double found = charges[static_cast<Eigen::Index>(e)];
    const double size = std::abs(found) + std::abs(recorded->second) +
                        size_of_terms(model, model.electrodes[e], products, state);
    if (std::abs(found - recorded->second) > same_charge * size)
      fail_from(
          model.asked.initial,
          fmt::format("electrode \"{}\" had the charge {:g} in that run, and by the materials of "
                      "this case and its charges and foundations at t = 0 its start has {:g}; "
                      "what it keeps must be one number: let these begin where they were (they "
                      "may change behind t = 0, as by a factor (t > 0))",
                      electrode.name, recorded->second, found));
  }
}

template <int dim>
std::vector<double> state_of_other(solve::Model<dim> &model) {
  InitialCase &initial = model.asked.initial;
  require_recorded_file(initial);
  require_finished(initial);
  const casefile::Case other = recorded_case(initial);
  if (other.dimension != dim)
    fail_from(initial,
              fmt::format("that run has {} dimensions, this case {}", other.dimension, dim));
  require_recorded(model, other);
  require_one_theory(model, other);
  RecordedState from = recorded_state<dim>(initial);
  const std::vector<Vector3> points = all_points(model.body.points(), model.sharing());
  const bool is_same_mesh = are_nodes_of<dim>(from, points);
  if (!is_same_mesh)
    from.unknowns = interpolated<dim>(initial, from, points);
  if (!is_same_mesh || from.points.size() > points.size())
    require_whole(model, from);
  from.unknowns.resize(points.size() * Fields<dim>::count);
  require_unknowns<dim>(model.asked, from.unknowns);
  std::vector<double> state = model.sharing().part_of(std::move(from.unknowns));
  level_electrodes(model, state);
  if (casefile::all_voltages_given(model.asked))
    return state;
  const RecordedRow last(initial);
  for (const casefile::ElectrodeCase &electrode : model.asked.electrodes)
    require_same_source(initial, electrode, other, last);
  initial.charges = charges_of(model.asked, last);
  if (is_same_mesh && have_same_cells(model.asked.mesh, other.mesh))
    require_same_charges(model, state, initial.charges);
  return state;
}

}  // namespace

template <int dim>
std::vector<double> start_state(solve::Model<dim> &model) {
  InitialCase &initial = model.asked.initial;
  if (initial.from && !initial.state)
    initial.state = std::make_shared<std::vector<double>>(state_of_other(model));
  return body::initial_state(model.body, initial);
}

std::vector<fs::path> start_files(const InitialCase &initial) {
  if (!initial.from)
    return {};
  require_recorded_file(initial);
  std::vector<fs::path> files{recorded_file(initial)};
  if (files.front().extension() != ".pvtu")
    return files;
  const std::string piece = files.front().stem().string() + "_";
  std::error_code ignored;
  for (fs::directory_iterator entry(*initial.from, ignored), end; !ignored && entry != end;
       entry.increment(ignored))
    if (entry->path().filename().string().starts_with(piece))
      files.push_back(entry->path());
  std::sort(files.begin(), files.end());
  return files;
}

void require_other_folder(const InitialCase &initial, const fs::path &results) {
  std::error_code ignored;
  if (initial.from && fs::equivalent(*initial.from, results, ignored))
    fail_from(initial,
              "is where the results of this run are for, and would be removed at its start; "
              "name another folder with -o");
}

template std::vector<double> start_state<2>(solve::Model<2> &);
template std::vector<double> start_state<3>(solve::Model<3> &);

}  // namespace tourmaline::run
