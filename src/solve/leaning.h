#pragma once

#include <functional>
#include <string>
#include <vector>

#include "case/free_modes.h"
#include "case/holding.h"
#include "solve/contact_nodes.h"
#include "solve/interface_newton.h"
#include "solve/model.h"

/// Bodies that only their contact holds: what to say where it does not.
namespace tourmaline::solve {

/// The rigid motions that nothing but contact keeps the body from, in words; empty: none, or
/// inertia or damping do in this run.
template <int dim>
std::string resisted_by_contact_alone(const Model<dim> &model);

/// What holds the body, contact nodes having this `status`: supports, normals where it touches, and
/// all directions where a node that does `rubs`.
template <int dim>
std::vector<casefile::Support> supports_of(const Model<dim> &model,
                                           const std::vector<ContactStatus> &status,
                                           const std::function<bool(std::size_t node)> &rubs);

/// The rigid motions that these supports leave free, about the middle of the body.
template <int dim>
std::vector<casefile::RigidMotion> free_modes_of(const Model<dim> &model,
                                                 const std::vector<casefile::Support> &supports);

/// The rigid motions that are left where the contact nodes that stick or touch, by their `status`,
/// are all that holds the body beside its supports, as a phrase; empty: none.
template <int dim>
std::string unheld_motions(const Model<dim> &model, const std::vector<ContactStatus> &status);
/// Of the contact's nodes, from the status of its points.
template <int dim>
std::vector<ContactStatus> status_by_node(const Model<dim> &model, const ContactNodes<dim> &contact,
                                          const std::vector<ContactStatus> &status);
/// The same by the status of the contact's points.
template <int dim>
std::string unheld_motions(const Model<dim> &model, const ContactNodes<dim> &contact,
                           const std::vector<ContactStatus> &status);

/// Whether it follows from a solution that does not hold that there is none: not where it ended
/// before Newton's method had the iterations that it is allowed by default.
template <int dim>
bool is_conclusive(const Model<dim> &model, const InterfaceSolution &solution);

/// Throws SolveError: the loads carry the body off by these motions.
[[noreturn]] void let_go(double time, const std::string &motions);

/// Throws SolveError: no equilibrium was found. `left_to_contact`: the motions that only the
/// contact keeps the body from.
[[noreturn]] void give_up_leaning(double time, const InterfaceSolution &solution,
                                  const std::string &left_to_contact);

}  // namespace tourmaline::solve
