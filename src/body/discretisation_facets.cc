// Facets on the boundary, and those inside that are asked for.

#include <algorithm>

#include "discretisation_parts.h"
#include "parallel/ranks.h"
#include "tourmaline/error.h"

namespace tourmaline::body {

// Facets are listed cell by cell, by their numbers in each.
template <int dim>
void Discretisation<dim>::Parts::list_facets(const mesh::Mesh<dim> &mesh) {
  boundaries = mesh.boundaries;
  for (const auto &named : mesh.inner)
    inner[named.first];
  std::size_t number = 0;
  for (const auto &cell : mesh.cells->active_cell_iterators()) {
    if (!cell->is_locally_owned())
      continue;
    for (const unsigned int f : cell->face_indices()) {
      const bool is_outer = cell->at_boundary(f);
      if (is_outer)
        outer.push_back({number, f, cell->face(f)->boundary_id(), true});
      for (const auto &[name, facets] : mesh.inner)
        if (facets.contains(mesh::corners_of<dim>(*cell->face(f))))
          inner[name].push_back({number, f, 0, is_outer || cell->id() < cell->neighbor(f)->id()});
    }
    ++number;
  }
}

template <int dim>
std::vector<Node> Discretisation<dim>::Parts::nodes_of(const Facet &facet) const {
  const std::span<const Node> of_cell = nodes_of(facet.cell);
  std::vector<Node> nodes;
  for (const unsigned int local : reference_facets[facet.number].nodes)
    nodes.push_back(of_cell[local]);
  return nodes;
}

template <int dim>
std::vector<Vector3> Discretisation<dim>::Parts::corners_of(const Facet &facet) const {
  std::vector<Vector3> corners;
  for (const unsigned int local : reference_facets[facet.number].corners)
    corners.push_back(points[nodes_of(facet.cell)[local]]);
  return corners;
}

template <int dim>
bool Discretisation<dim>::Parts::lies_on_axis(const Facet &facet) const {
  const std::vector<Vector3> corners = corners_of(facet);
  return geometry == Geometry::revolved &&
         std::all_of(corners.begin(), corners.end(),
                     [&](const Vector3 &corner) { return corner[0] <= axis_ends; });
}

template <int dim>
auto Discretisation<dim>::Parts::outer_in(const std::set<unsigned int> &ids) const
    -> std::vector<Facet> {
  std::vector<Facet> facets;
  std::copy_if(outer.begin(), outer.end(), std::back_inserter(facets),
               [&](const Facet &facet) { return ids.contains(facet.id); });
  return facets;
}

template <int dim>
std::set<unsigned int> Discretisation<dim>::Parts::ids_of(
    const std::vector<std::string> &names) const {
  std::set<unsigned int> ids;
  for (const std::string &name : names) {
    const auto found = boundaries.find(name);
    if (found == boundaries.end())
      throw CaseError("the mesh has no boundary named \"" + name + "\"");
    ids.insert(found->second.begin(), found->second.end());
  }
  return ids;
}

template <int dim>
void Discretisation<dim>::for_each_facet(
    const std::vector<std::string> &boundaries,
    const std::function<void(const Quadrature<dim> &)> &visit) const {
  visit_facets(parts_->ids_of(boundaries), visit);
}

template <int dim>
bool Discretisation<dim>::is_boundary(const std::string &name) const {
  return parts_->boundaries.contains(name);
}

template <int dim>
void Discretisation<dim>::for_each_facet_on_both(
    const std::vector<std::string> &boundaries, const std::vector<std::string> &others,
    const std::function<void(const Quadrature<dim> &)> &visit) const {
  std::set<unsigned int> ids = parts_->ids_of(boundaries);
  const std::set<unsigned int> other_ids = parts_->ids_of(others);
  std::erase_if(ids, [&](unsigned int id) { return !other_ids.contains(id); });
  visit_facets(ids, visit);
}

template <int dim>
void Discretisation<dim>::visit_facets(
    const std::set<unsigned int> &ids,
    const std::function<void(const Quadrature<dim> &)> &visit) const {
  Quadrature<dim> values;
  typename Parts::Corners places;
  for (const typename Parts::Facet &facet : parts_->outer_in(ids)) {
    const ReferenceFacet<dim> &reference = parts_->reference_facets[facet.number];
    const auto nodes = parts_->nodes_of(facet.cell);
    values.nodes.assign(nodes.begin(), nodes.end());
    reference.shapes.fill_facet(parts_->corners_of(facet.cell, places), reference.tangents, values);
    parts_->revolve(values);
    visit(values);
  }
}

// What all ranks' facets have.
template <int dim>
std::vector<Node> Discretisation<dim>::Parts::joined_nodes_of(
    const std::vector<Facet> &facets) const {
  std::vector<Node> nodes;
  for (const Facet &facet : facets)
    if (!lies_on_axis(facet))
      for (const Node node : nodes_of(facet))
        nodes.push_back(sharing.number(node));
  nodes = parallel::joined(nodes);
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return sharing.nodes(nodes);
}

template <int dim>
std::vector<Node> Discretisation<dim>::nodes_on(const std::vector<std::string> &boundaries) const {
  std::vector<std::string> outer;
  std::vector<typename Parts::Facet> facets;
  for (const std::string &name : boundaries)
    if (const auto found = parts_->inner.find(name); found != parts_->inner.end())
      facets.insert(facets.end(), found->second.begin(), found->second.end());
    else
      outer.push_back(name);
  const auto of_outer = parts_->outer_in(parts_->ids_of(outer));
  facets.insert(facets.end(), of_outer.begin(), of_outer.end());
  return parts_->joined_nodes_of(facets);
}

template <int dim>
std::vector<Node> Discretisation<dim>::nodes_inside(
    const std::function<bool(const Vector3 &)> &belongs) const {
  std::vector<typename Parts::Facet> facets;
  parallel::together([&] {
    auto next_outer = parts_->outer.begin();
    for (std::size_t cell = 0; cell < parts_->n_cells(); ++cell)
      for (unsigned int f = 0; f < parts_->reference_facets.size(); ++f) {
        if (next_outer != parts_->outer.end() && next_outer->cell == cell &&
            next_outer->number == f) {
          ++next_outer;
          continue;
        }
        const typename Parts::Facet facet{cell, f, 0, true};
        const std::vector<Vector3> corners = parts_->corners_of(facet);
        if (std::all_of(corners.begin(), corners.end(), belongs))
          facets.push_back(facet);
      }
  });
  return parts_->joined_nodes_of(facets);
}

template void Discretisation<2>::Parts::list_facets(const mesh::Mesh<2> &);
template std::vector<Node> Discretisation<2>::Parts::nodes_of(const Facet &) const;
template std::vector<Discretisation<2>::Parts::Facet> Discretisation<2>::Parts::outer_in(
    const std::set<unsigned int> &) const;
template void Discretisation<2>::for_each_facet(
    const std::vector<std::string> &, const std::function<void(const Quadrature<2> &)> &) const;
template void Discretisation<2>::for_each_facet_on_both(
    const std::vector<std::string> &, const std::vector<std::string> &,
    const std::function<void(const Quadrature<2> &)> &) const;
template bool Discretisation<2>::is_boundary(const std::string &) const;
template std::vector<Node> Discretisation<2>::nodes_on(const std::vector<std::string> &) const;
template std::vector<Node> Discretisation<2>::nodes_inside(
    const std::function<bool(const Vector3 &)> &) const;
template void Discretisation<3>::Parts::list_facets(const mesh::Mesh<3> &);
template std::vector<Node> Discretisation<3>::Parts::nodes_of(const Facet &) const;
template std::vector<Discretisation<3>::Parts::Facet> Discretisation<3>::Parts::outer_in(
    const std::set<unsigned int> &) const;
template void Discretisation<3>::for_each_facet(
    const std::vector<std::string> &, const std::function<void(const Quadrature<3> &)> &) const;
template void Discretisation<3>::for_each_facet_on_both(
    const std::vector<std::string> &, const std::vector<std::string> &,
    const std::function<void(const Quadrature<3> &)> &) const;
template bool Discretisation<3>::is_boundary(const std::string &) const;
template std::vector<Node> Discretisation<3>::nodes_on(const std::vector<std::string> &) const;
template std::vector<Node> Discretisation<3>::nodes_inside(
    const std::function<bool(const Vector3 &)> &) const;

}  // namespace tourmaline::body
