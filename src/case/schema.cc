#include "case/schema.h"

#include <fmt/format.h>

#include <cstdint>
#include <limits>

#include "case/interval.h"
#include "schema_parts.h"
#include "sense.h"
#include "tourmaline/case/case.h"

namespace tourmaline::casefile {

namespace {

void declare(Visitor &v, IntervalCase &interval) {
  v.key({.name = "until",
         .description = "time at which the interval ends; it begins where the one before ends, the "
                        "first one at 0",
         .unit = "s",
         .required = true,
         .range = positive(sense::time)},
        &interval.until);
  v.key({.name = "steps",
         .description = "number of equal time steps in it",
         .required = true,
         .range = at_least(1)},
        &interval.steps);
}

std::string intervals_complaint(const std::vector<IntervalCase> &intervals) {
  if (intervals.empty())
    return "is an empty list; give at least one interval, or `end` and `steps`";
  double begin = 0;
  std::int64_t steps = 0;
  for (std::size_t i = 0; i < intervals.size(); ++i) {
    const double until = intervals[i].until;
    if (!(until > begin))
      return fmt::format(
          "interval[{}] ends at {} s and begins at {} s, where the one before it ends; each must "
          "end later than that",
          i, until, begin);
    begin = until;
    steps += intervals[i].steps;
  }
  if (steps > std::numeric_limits<int>::max())
    return fmt::format("has {} steps in all, and at most {} are possible", steps,
                       std::numeric_limits<int>::max());
  return "";
}

void declare(Visitor &v, TimeCase &time) {
  const Key intervals{.name = "interval",
                      .description =
                          "Steps of different sizes, instead of `end` and `steps`: "
                          "intervals one after the other, each of equal steps. The body "
                          "is factorised once for each size",
                      .optional = true};
  const bool has_intervals = v.given(intervals, !time.intervals.empty());
  const Use equal{!has_intervals, "no [[time.interval]]"};
  v.key({.name = "end",
         .description = "time at which the simulation ends; it begins at 0",
         .unit = "s",
         .required = true,
         .range = positive(sense::time),
         .used = equal},
        &time.end);
  v.key({.name = "steps",
         .description = "number of equal time steps (backward Euler)",
         .required = true,
         .range = at_least(1),
         .used = equal},
        &time.steps);
  if (has_intervals) {
    v.entries(intervals, time.intervals,
              [](Visitor &inner, IntervalCase &one) { declare(inner, one); });
    v.check("interval", [&] { return intervals_complaint(time.intervals); });
  }
  v.one_group({{"end", "steps"}, {"interval"}});
  if (!time.intervals.empty()) {
    time.end = time.intervals.back().until;
    time.steps = 0;
    for (const IntervalCase &one : time.intervals)
      time.steps += one.steps;
  }
  v.key({.name = "regime",
         .description =
             "quasistatic: heat takes its time (backward Euler), forces balance in every step; "
             "static: nothing has a rate, t is only the parameter of the loads, heat flows "
             "steadily, and friction goes in increments from one load level to the next; dynamic: "
             "quasistatic with the inertia of the materials' `density`, by Newmark's scheme with "
             "1/4 and 1/2",
         .choices = {"quasistatic", "static", "dynamic"}},
        &time.regime);
  v.optional({.name = "tolerance",
              .description =
                  "the program chooses the steps, `steps` is the least number of them: each errs "
                  "by at most so much of the largest change of u, phi and theta so far, and times "
                  "at which the contact status changes by so much of `end`; no step goes across a "
                  "bend of a load table",
              .range = {.low = 1e-8, .high = 0.1, .sense = sense::tolerance},
              .used = with("regime", time.regime, {"quasistatic"})},
             time.tolerance);
  v.check("tolerance", [&] {
    return time.tolerance && has_intervals
               ? std::string(
                     "chooses the sizes of the steps, as `interval` does; give `end` and "
                     "`steps` with it, or leave it out")
               : std::string();
  });
  v.key({.name = "contact_mass",
         .description = "redistributed: the mass of contact nodes goes to the other nodes of their "
                        "cells, so that contact forces do not chatter; consistent: it stays",
         .choices = {"redistributed", "consistent"},
         .used = with("regime", time.regime, {"dynamic"})},
        &time.contact_mass);
}

void declare(Visitor &v, LoadCase &load, int dimension) {
  v.key({.name = "force",
         .description = "force f_0 on the volume (4)",
         .unit = "N/m^3",
         .range = any(sense::volume_force),
         .length = one_each_axis(dimension),
         .default_words = "none"},
        &load.force);
  v.key({.name = "base_acceleration",
         .description = "acceleration a of supports and foundations, which displacements are "
                        "measured to: the force -density a on the volume, of formulas in t",
         .unit = "m/s^2",
         .range = any(sense::acceleration),
         .length = one_each_axis(dimension),
         .default_words = "none"},
        &load.base_acceleration);
  v.check("base_acceleration", [&]() -> std::string {
    for (const Formula &component : load.base_acceleration)
      if (component.depends_on_place())
        return "depends on place; a base is rigid, so give formulas in t alone, and forces that "
               "differ from place to place as `force`";
    return "";
  });
  v.key({.name = "charge",
         .description = "free charge phi_0 in the volume (5)",
         .unit = "C/m^3",
         .range = any(sense::charge)},
        &load.charge);
  v.key({.name = "heat",
         .description = "heat source q_0 in the volume (6)",
         .unit = "W/m^3",
         .range = any(sense::heat_source)},
        &load.heat);
}

void declare(Visitor &v, InitialCase &initial, const TimeCase &time, int dimension) {
  v.places(initial.places);
  v.optional({.name = "from",
              .description = "results folder of a run from whose displacement, potential and "
                             "temperature this one starts, at its own time 0; on another mesh of "
                             "the same body they are interpolated; seen from the case's folder"},
             initial.from);
  if (initial.from)
    v.locate("from", *initial.from);
  v.optional({.name = "step",
              .description = "step of that run, of which it has fields; its last one if not given",
              .range = from_to(0, std::numeric_limits<int>::max()),
              .used = with("from", initial.from.has_value())},
             initial.step);
  const Use without_from = {!initial.from, "a start of the case's own, without `from`"};
  v.key({.name = "displacement",
         .description = "displacement u_0 at the time 0",
         .unit = "m",
         .range = any(sense::coordinate),
         .length = one_each_axis(dimension),
         .constant_in_time = true,
         .default_words = "zero",
         .used = without_from},
        &initial.displacement);
  v.key({.name = "velocity",
         .description = "velocity at the time 0, of a dynamic case",
         .unit = "m/s",
         .range = any(sense::velocity),
         .length = one_each_axis(dimension),
         .constant_in_time = true,
         .default_words = "zero"},
        &initial.velocity);
  v.check("velocity", [&] {
    return initial.velocity.empty() || time.is_dynamic()
               ? std::string()
               : fmt::format(
                     "is only used with time.regime = \"dynamic\", and the regime is \"{}\"",
                     time.regime);
  });
  v.key({.name = "potential",
         .description = "electric potential at the time 0",
         .unit = "V",
         .range = any(sense::potential),
         .constant_in_time = true,
         .used = without_from},
        &initial.potential);
  v.key(
      {.name = "temperature",
       .description = "temperature theta_0 at the time 0, difference to the reference temperature",
       .unit = "K",
       .range = any(sense::temperature),
       .constant_in_time = true,
       .used = without_from},
      &initial.temperature);
}

void declare(Visitor &v, ModelCase &model, int dimension) {
  v.key({.name = "plane",
         .description =
             "what a two-dimensional body is. strain: it is long across the plane, or held there, "
             "so that nothing strains across it; stress: it is thin across the plane and free "
             "there, so that no stress acts across it; either way forces, charges and heats are "
             "those of a metre of depth. axisymmetric: it is the half section of a body of "
             "revolution, x its radius and y its axis, and all is that of the whole body. The "
             "potential does not vary across the plane",
         .choices = {"strain", "stress", "axisymmetric"},
         .used = {dimension == 2, "a mesh of two dimensions"}},
        &model.plane);
  v.key({.name = "thermal",
         .description = "false: the temperature stays that of reference everywhere, and no thermal "
                        "constants are needed"},
        &model.thermal);
  v.key({.name = "electric",
         .description = "false: the potential is zero everywhere, and no electric constants are "
                        "needed"},
        &model.electric);
}

void declare_augmented_lagrangian(Visitor &v, SolverCase &solver) {
  const Use monolithic = with("method", solver.method, {"monolithic"});
  const std::string from_stiffness = "from the stiffness of the body at the contact";
  v.key({.name = "multiplier",
         .description = "where the contact multipliers live; nodal: at the contact nodes, with "
                        "lumped weights; piecewise-constant: on the facets (section 3.1), with "
                        "the facet means of u_nu and du_tau",
         .choices = {"nodal", "piecewise-constant"},
         .used = monolithic},
        &solver.multiplier);
  v.optional({.name = "r_normal",
              .description = "r_nu of the augmented Lagrangian (40); it changes the number of "
                             "iterations, not the solution",
              .unit = "N/m^3",
              .range = positive(sense::augmentation),
              .default_words = from_stiffness,
              .used = monolithic},
             solver.r_normal);
  v.optional({.name = "r_tangential",
              .description = "r_tau of the augmented Lagrangian (41), which multiplies the slip "
                             "rate du_tau / k; it changes the number of iterations, not the "
                             "solution",
              .unit = "N s/m^3",
              .range = positive(sense::augmentation),
              .default_words = from_stiffness,
              .used = monolithic},
             solver.r_tangential);
}

void declare(Visitor &v, SolverCase &solver, const std::vector<ContactCase> &contacts) {
  v.key(
      {.name = "method",
       .description = "condensed: one factorisation for all steps, Newton iteration on the contact "
                      "boundary; monolithic: Newton iteration on all unknowns, as in the paper",
       .choices = {"condensed", "monolithic"}},
      &solver.method);
  v.key({.name = "body",
         .description =
             "how the body's linear equations are solved. direct: one factorisation; iterative: "
             "preconditioned Krylov iteration, for bodies in three dimensions that are too large "
             "for a factorisation; automatic: direct where its estimated memory is at most half of "
             "what is available",
         .choices = {"automatic", "direct", "iterative"},
         .used = with("method", solver.method, {"condensed"})},
        &solver.body);
  v.key({.name = "factorisation",
         .description =
             "who factorises the body's matrix. own: without pivoting, on one rank, with "
             "solver.threads; mumps: MUMPS; automatic: own on one rank, MUMPS on several or where "
             "round-off leaves a pivot without a digit",
         .choices = {"automatic", "own", "mumps"},
         .used = {solver.method == "condensed" && solver.body != "iterative",
                  "method = \"condensed\" and body = \"automatic\" or \"direct\""}},
        &solver.factorisation);
  v.key(
      {.name = "linear_tolerance",
       .description = "at which the iterative solution of the body's equations stops: norm of the "
                      "residual over that of the largest contribution, in each field",
       .range = {.low = 0, .high = 1e-3, .low_allowed = false, .sense = sense::tolerance},
       .used = with("body", solver.body, {"iterative", "automatic"})},
      &solver.linear_tolerance);
  v.key({.name = "tolerance",
         .description = "at which the contact iteration stops: natural residual divided by the "
                        "largest nodal force; of a body that is solved iteratively ten times the "
                        "larger of this and linear_tolerance",
         .range = {.low = 0,
                   .high = 1,
                   .low_allowed = false,
                   .high_allowed = false,
                   .sense = sense::tolerance}},
        &solver.tolerance);
  v.key({.name = "max_iterations",
         .description =
             "Newton iterations after which an attempt at a step fails: the only one where "
             "the step is convex, one of several where friction depends on the pressure; from "
             "2,000 points on (two a contact node) so many for each thousand; with body = "
             "\"iterative\" a contact of at most ten times as many unknowns gets a matrix of its "
             "own where less does not help",
         .range = at_least(1)},
        &solver.max_iterations);
  v.key({.name = "threads",
         .description = "of the factorisation and of OpenBLAS",
         .range = from_to(1, 1024)},
        &solver.threads);
  declare_augmented_lagrangian(v, solver);
  v.check("multiplier", [&] { return multiplier_complaint(contacts, solver.multiplier); });
}

void declare(Visitor &v, OutputCase &output) {
  v.key({.name = "fields",
         .description =
             "whether VTU files are written; without them only the tables and the summary"},
        &output.fields);
  v.optional({.name = "every",
              .description = "steps between two field files",
              .range = at_least(1),
              .default_words = "time.steps / 50, rounded up: at most about 50 files; with "
                               "time.tolerance the first step in each 50th of the time"},
             output.every);
  v.key({.name = "report", .description = "whether the report, a web page, is written"},
        &output.report);
  v.key({.name = "checkpoint",
         .description =
             "how often a run saves what `--resume` needs to go on from there: every so many "
             "steps, \"10 steps\", or after some time, \"30 s\", \"5 min\", \"2 h\"; \"never\" "
             "leaves it to the signals that stop a run"},
        &output.checkpoint);
  v.check("checkpoint", [&] { return interval_complaint(output.checkpoint); });
}

}  // namespace

void declare(Visitor &v, Case &c) {
  v.key({.name = "title", .description = "what the run is called in its results"}, &c.title);
  v.table({.name = "mesh", .description = "The body's shape and its cells", .required = true},
          [&](Visitor &inner) { declare(inner, c.mesh); });
  c.dimension = dimension_of(c.mesh);
  v.table({.name = "model", .description = "Which equations are solved"},
          [&](Visitor &inner) { declare(inner, c.model, c.dimension); });
  declare_composition(v, c);
  v.table({.name = "time", .description = "The simulated time", .required = true},
          [&](Visitor &inner) { declare(inner, c.time); });
  declare_boundaries(v, c.boundaries, c.mesh, c.dimension);
  declare_electrodes(v, c.electrodes, c.mesh, c.is_per_depth());
  declare_contacts(v, c.contacts, c.mesh, c.dimension, c.is_per_depth());
  v.table({.name = "load", .description = "Loads on the volume"},
          [&](Visitor &inner) { declare(inner, c.load, c.dimension); });
  v.table({.name = "initial", .description = "The state at the time 0"},
          [&](Visitor &inner) { declare(inner, c.initial, c.time, c.dimension); });
  v.table({.name = "solver", .description = "How the equations are solved"},
          [&](Visitor &inner) { declare(inner, c.solver, c.contacts); });
  declare_probes(v, c.probes, c.mesh, c.dimension, c.model.is_axisymmetric());
  v.table({.name = "output", .description = "What a run leaves in its folder"},
          [&](Visitor &inner) { declare(inner, c.output); });
}

}  // namespace tourmaline::casefile
