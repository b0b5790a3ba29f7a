#include "run/expected_cost.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <thread>

#include "condensation/condensed_body.h"
#include "condensation/factorisation_choice.h"
#include "parallel/ranks.h"
#include "run/machine_speed.h"
#include "run/memory.h"
#include "run/process.h"
#include "run/rehearsal.h"
#include "solve/exchange_nodes.h"
#include "stopwatch.h"
#include "tourmaline/case/case.h"
#include "tourmaline/error.h"

namespace tourmaline::run {

namespace {

// All numbers of the model are fitted to the runs of docs/measurements.md ("What a run will take").

constexpr double bare_process = 180e6;  // bytes, the libraries

enum class Way { own, mumps, monolithic, iterative };

/// A run as the model sees it, on one rank.
struct Job {
  Way way = Way::own;
  int dimension = 2, threads = 1, cores = 1, sizes = 1;
  double nodes = 0, unknowns = 0, kept = 0;  ///< kept: unknowns of the contact
  double fronts = 0, operations = 0;         ///< of the factorisation
  double factor = 0, contact = 0;  ///< bytes, of the factor and of a matrix of the contact
  double started = 0, mesh = 0, assembled = 0, planned = 0;  ///< seconds, measured
  double iterative_memory = 0;
  MachineSpeed speed;
};

struct Cost {
  double memory = 0;            ///< bytes, of all ranks
  double set_up = 0, step = 0;  ///< seconds
};

// Of work that is shared out; memory's bandwidth does not grow with the cores.
double shared(double seconds, int by, int cores) {
  return seconds / std::pow(std::min(by, cores), 0.55);
}

// Newton iterations of the contact, and what a step costs beside the body's equations: loads,
// balances, tables.
double contact_seconds(const Job &job) {
  const double in_space = job.dimension == 2 ? 1 : 1.7;
  return in_space * (14 * job.contact / job.speed.reading + 2e-6 * job.kept +
                     0.2 * std::pow(job.kept, 3) / job.speed.operations);
}
double other_seconds(const Job &job) {
  const double read_of_a_node = job.dimension == 2 ? 1e4 : 5e4;  // bytes
  return job.nodes * read_of_a_node / job.speed.reading;
}

double own_factorisation(const Job &job) {
  return 1.7 * job.operations / job.speed.operations + 0.32 * job.factor / job.speed.taking +
         1e-4 * job.fronts;
}
double own_substitutions(const Job &job) {
  return 2.7 * job.factor / job.speed.reading + 2e-7 * job.fronts;
}
double factorisation_by_mumps(const Job &job) {
  return job.operations / job.speed.operations + 40 * job.factor / job.speed.reading;
}
double substitutions_by_mumps(const Job &job) {
  return 4.1 * job.factor / job.speed.reading + 1.5e-6 * job.nodes;
}

// On several ranks MUMPS factorises, and every rank makes the whole mesh.
Cost factorised(const Job &job, int ranks) {
  const bool by_mumps = ranks > 1 || job.way == Way::mumps;
  const int by = ranks * job.threads;
  const double factorise = by_mumps ? factorisation_by_mumps(job) : own_factorisation(job);
  const double substitute = by_mumps ? substitutions_by_mumps(job) : own_substitutions(job);
  const double times = by_mumps ? 1.8 + 0.45 * (ranks - 1) : 1.32;
  return {
      bare_process * ranks + times * job.factor * job.sizes + 1200 * job.nodes + 3.3 * job.contact,
      job.planned + shared(factorise, by, job.cores) * job.sizes,
      shared(substitute, by, job.cores) + contact_seconds(job) +
          shared(other_seconds(job), ranks, job.cores)};
}

// Each of some four Newton iterations factorises; its matrix has the multipliers' rows as well.
Cost monolithic(const Job &job, int ranks) {
  constexpr int iterations = 4;
  Job by_mumps = job;
  by_mumps.way = Way::mumps;
  Cost cost = factorised(by_mumps, ranks);
  cost.set_up = 0;
  cost.step = iterations * shared(factorisation_by_mumps(job), ranks * job.threads, job.cores) +
              shared(iterations * substitutions_by_mumps(job) + other_seconds(job),
                     ranks * job.threads, job.cores);
  return cost;
}

// How many linear iterations there are depends on body and contact; this is what most have. Several
// ranks hold more of the products that coarse matrices are made of.
Cost iterative(const Job &job, int ranks) {
  const double solve = 1e6 * job.unknowns / job.speed.reading, more = ranks > 1 ? 1.3 : 1;
  return {more * job.iterative_memory + bare_process * (ranks - 1),
          shared(solve / 4, ranks, job.cores), shared(solve, ranks, job.cores)};
}

Cost cost_of(const Job &job, int ranks) {
  Cost cost = job.way == Way::monolithic  ? monolithic(job, ranks)
              : job.way == Way::iterative ? iterative(job, ranks)
                                          : factorised(job, ranks);
  cost.set_up += job.started + 0.2 * (ranks - 1) + job.mesh * (ranks > 1 ? 1 + ranks : 1) +
                 shared(job.assembled, ranks, job.cores);
  return cost;
}

Way way_of(const casefile::Case &asked) {
  if (asked.solver.method == "monolithic")
    return Way::monolithic;
  if (solves_iteratively(asked))
    return Way::iterative;
  return condensation::choice_of(asked.solver).by == condensation::Factoriser::mumps ? Way::mumps
                                                                                     : Way::own;
}

bool is_for_one_rank(const casefile::SolverCase &solver) {
  return solver.factorisation == "own" || solver.multiplier == "piecewise-constant";
}

template <int dim>
void plan(const solve::Model<dim> &model, Job &job) {
  const auto plan = condensation::CondensedBody<dim>::plan(
      model.op, model.step, model.prescribed,
      solve::contact_unknowns(model, solve::exchange_sites(model)));
  job.unknowns = static_cast<double>(plan.unknowns);
  job.kept = static_cast<double>(plan.kept);
  job.fronts = static_cast<double>(plan.fronts);
  job.operations = plan.operations;
  job.factor = sizeof(double) * static_cast<double>(plan.entries);
  job.contact = sizeof(double) * job.kept * job.kept;
}

template <int dim>
Job job_of(const casefile::Case &asked) {
  Job job;
  job.way = way_of(asked);
  job.dimension = dim;
  job.threads = asked.solver.threads;
  job.cores = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  job.iterative_memory = iterative_memory(asked);
  job.started = process_age();
  solve::Model<dim> model(asked);
  rehearse_from_start(model);
  job.sizes = asked.time.tolerance ? 1 : model.steps.sizes(model.steps.count());
  job.mesh = model.mesh_seconds;
  job.assembled = model.assemble_seconds;
  job.nodes = static_cast<double>(model.body.n_nodes());
  job.unknowns = static_cast<double>(model.n_unknowns() - model.prescribed.size());
  Stopwatch watch;
  if (job.way != Way::iterative)
    plan(model, job);
  job.planned = watch.lap();
  try {
    job.speed = measured_speed(2);
  } catch (const MachineError &) {  // the run may still have what it needs
  }
  return job;
}

std::string factor_in_words(const Job &job) {
  if (job.way == Way::iterative)
    return "solved iteratively, times within a factor of four";
  return fmt::format("{:.3g} numbers in the factor, times within a factor of two",
                     job.factor / sizeof(double));
}

std::string row(const Job &job, const casefile::Case &asked, int ranks) {
  const Cost cost = cost_of(job, ranks);
  const std::string whole = asked.time.tolerance
                                ? "steps are chosen as they come"
                                : fmt::format("{:.2g}", cost.set_up + asked.time.steps * cost.step);
  return fmt::format("# {:>9}   {:>11.2g}   {:>9.2g}   {:>9.2g}   {}\n", ranks,
                     cost.memory / (1 << 30), cost.set_up, cost.step, whole);
}

}  // namespace

std::string expected_cost(const casefile::Case &asked) {
  if (parallel::n_ranks() > 1) {
    rehearse(asked);
    return "";
  }
  const Job job = asked.dimension == 2 ? job_of<2>(asked) : job_of<3>(asked);
  if (job.speed.reading == 0)
    return "\n# What a run will take is not told: there is no memory left to measure the "
           "machine.\n";
  std::string text = fmt::format(
      "\n# Expected on this machine ({} cores to run on), without field files and page: {:.0f} "
      "unknowns, "
      "{}\n# MPI ranks   memory, GiB   set-up, s   a step, s   all, s\n",
      job.cores, job.unknowns, factor_in_words(job));
  for (const int ranks : {1, 2, 4})
    if (ranks == 1 || !is_for_one_rank(asked.solver))
      text += row(job, asked, ranks);
  return text;
}

}  // namespace tourmaline::run
