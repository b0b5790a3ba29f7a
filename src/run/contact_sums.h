#pragma once

#include <string>
#include <utility>
#include <vector>

#include "output/records.h"
#include "output/summary.h"
#include "solve/model.h"
#include "solve/route.h"

namespace tourmaline::run {

/// The contact of that number by its name; empty where it is the only one.
std::string name_of_several(const std::vector<casefile::ContactCase> &contacts, std::size_t number);

/// What foundations with circuits have at `time`, the end of the step; then, where there are
/// several contacts, columns of history.csv for each, behind `quantities`: numbers of nodes by
/// status, forces and moments on the body, heat out of it. `quantities` are those of the step:
/// moments stand beside the one of all contacts, heats are the sums of those of boundaries.
template <int dim>
void add_contact_sums(const solve::Model<dim> &model, const solve::StepOutcome &outcome,
                      double time, std::vector<std::pair<std::string, double>> &quantities);

/// Where the contact can open or friction follows the pressure, columns of history.csv, behind
/// `quantities`: of the contact, and of each where there are several, the largest pressure [N/m^2]
/// and the largest opening [m]. `rows`: those of the contact nodes.
template <int dim>
void add_contact_extremes(const solve::Model<dim> &model,
                          const std::vector<output::ContactRow> &rows,
                          std::vector<std::pair<std::string, double>> &quantities);

/// For summary.json; empty where there are not several.
template <int dim>
std::vector<output::ContactRecord> contact_records(const solve::Model<dim> &model);

}  // namespace tourmaline::run
