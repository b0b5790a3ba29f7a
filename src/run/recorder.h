#pragma once

#include <array>
#include <functional>
#include <optional>

#include "body/recovery.h"
#include "output/result_folder.h"
#include "run/probes.h"
#include "run/schedule.h"
#include "solve/balance.h"
#include "solve/judgement.h"
#include "solve/model.h"
#include "solve/route.h"

namespace tourmaline::run {

/// Turns states into what the files hold: fields every so many steps, contact rows and a line of
/// history every step, the probes' rows likewise, nodes and extremes at the end.
template <int dim>
class Recorder {
 public:
  /// All ranks make one and call it together; the first writes the tables, each its own cells.
  Recorder(const solve::Model<dim> &model, output::ResultFolder &folder);

  /// `rates` of the start resist in a dynamic run.
  void initial(std::span<const double> state, const solve::RateRecord &rates);
  /// Goes on behind the step that had this state; what is there of it is in the folder.
  void restore(std::span<const double> state, const output::SavedNumbers &numbers);
  void save(output::SavedNumbers &numbers) const;
  /// Writes step n; returns its line of history. `loads` is the step's right-hand side without
  /// history, `route` the one that has taken the step. Throws SolveError, and then nothing of the
  /// step is written, where a number is not finite or `Judgement` fails the step; `measure` is for
  /// it.
  output::HistoryRow step(int n, const solve::StepOutcome &outcome, std::span<const double> loads,
                          std::span<const double> before, std::span<const double> state,
                          const solve::Route &route,
                          const std::function<solve::Accuracy()> &measure);
  /// The state that the last step ended in.
  const solve::BalancedState<dim> &balanced() const { return balance_->balanced(); }
  /// The last state's nodes, and the tables into place.
  void finish(std::span<const double> state);

  std::vector<output::Extreme> extremes(std::span<const double> state) const;
  double seconds() const { return seconds_; }
  /// About the steps so far.
  std::vector<std::string> warnings() const { return judgement_.warnings(); }

 private:
  output::PointFields point_fields(std::span<const double> state,
                                   std::span<const body::Node> nodes) const;
  std::vector<output::ContactRow> contact_rows(int n, const solve::StepOutcome &outcome,
                                               std::span<const double> before,
                                               std::span<const double> state) const;
  void put_boundaries();
  void prepare_fields();
  bool has_fields(int n) const { return writes_fields(model_.asked, model_.steps, n); }
  output::CellFields checked_fields(int n, std::span<const double> state);
  void put_fields(int n, std::span<const double> state, const output::CellFields &cells);
  bool has_contact() const { return !model_.asked.contacts.empty(); }
  double flux(contact::Crossing what, std::size_t i, double value, double time,
              const Eigen::VectorXd &flow) const;
  double charge_flux(const solve::StepOutcome &outcome, std::size_t i, double phi,
                     double time) const;

  const solve::Model<dim> &model_;
  output::ResultFolder &folder_;
  // Of the field files, if any are written.
  std::optional<body::Recovery<dim>> recovery_;
  output::Grid grid_;                 // this rank's cells and the nodes they use, by region
  std::vector<std::uint32_t> nodes_;  // of the grid: regional nodes
  // By contact, of heat and of charge: what crosses by place alone.
  std::vector<std::array<std::optional<body::SurfaceExchange>, 2>> linear_;
  output::ContactFacets contact_facets_;  // on the first rank
  std::optional<solve::Balance<dim>> balance_;
  solve::Judgement judgement_;
  Probes<dim> probes_;
  double seconds_ = 0;
};

}  // namespace tourmaline::run
