#include "run/chosen_route.h"

#include <gmock/gmock.h>

#include <gtest/gtest.h>
#include <optional>

#include "../cases/leaning_body.h"
#include "solve/condensed_route.h"
#include "tourmaline/case/reader.h"

namespace tourmaline::run {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using State = std::vector<double>;

// A beam 10 000 times as long as thick, loaded in the second step only: too much for the iterative
// solution.
constexpr const char *beam = R"toml(
mesh.box = { min = [0, 0, 0], max = [1, 1e-4, 1e-4], cells = [20, 1, 1], cell = "hexahedron" }
mesh.degree = 2
material = { symmetry = "isotropic", young = 1e9, poisson = 0, eps11 = 10, k11 = 1, density = 1000, specific_heat = 1000, reference_temperature = 293 }
time = { end = 1, steps = 3 }
boundary = [
  { on = "right", displacement = [0, 0, 0], potential = 0, temperature = 0 },
  { on = "left", traction = [0, 0, "if(t < 0.5, 0, -1e-6*t)"] } ]
)toml";

class WayBack : public ::testing::Test {
 protected:
  static casefile::Case with(const std::string &body) {
    return casefile::read_text(beam, "beam.toml", {"solver.body=" + body});
  }

  // The state after a step that `advance` takes; nothing moves what is prescribed.
  template <class Advance>
  static State step(const solve::Model<3> &model, int n, const State &before,
                    const Advance &advance) {
    State right_side(model.n_unknowns(), 0.), next = before;
    model.loads.integrate(model.time(n), right_side);
    body::add_history<3>(model.products_by_field(before, false), right_side);
    advance(n, right_side, before, next);
    return next;
  }

  State step(ChosenRoute<3> &route, int n, const State &before) const {
    return step(model_, n, before, [&](auto &&...numbers) { route.advance(numbers...); });
  }

  State factorised_step(int n, const State &before) {
    return step(model_, n, before,
                [&](int, auto &&...numbers) { factorised_->advance(model_.time(n), numbers...); });
  }

  solve::Model<3> model_{with("automatic")};
  const std::unique_ptr<solve::Route> factorised_ = solve::condensed_route(model_);
  const State rest_ = State(model_.n_unknowns(), 0.);
  output::Progress progress_{3, 1, true};
};

TEST_F(WayBack, FromAnIterativeSolutionThatFailsIsTheFactorisation) {
  ChosenRoute<3> route(model_, true, progress_);
  const State first = step(route, 1, rest_);
  EXPECT_EQ(first, rest_);
  EXPECT_THAT(route.warnings(), ElementsAre(HasSubstr("were solved iteratively")));
  const State second = step(route, 2, first), third = step(route, 3, second);
  EXPECT_THAT(route.warnings(), ElementsAre(HasSubstr("failed in step 2; from there on")));
  EXPECT_EQ(factorised_step(1, rest_), rest_);
  EXPECT_EQ(second, factorised_step(2, rest_));
  EXPECT_EQ(third, factorised_step(3, second));
  EXPECT_NE(third, second);
  EXPECT_EQ(route.route().report().factorisations, 1);
}

TEST_F(WayBack, IsRememberedByWhatGoesOn) {
  ChosenRoute<3> route(model_, true, progress_);
  const State second = step(route, 2, step(route, 1, rest_));
  output::SavedNumbers saved;
  route.save(saved);
  ASSERT_FALSE(ChosenRoute<3>::was_iterative(saved));
  ChosenRoute<3> other(model_, false, progress_);
  other.restore(saved);
  EXPECT_EQ(other.warnings(), route.warnings());
  EXPECT_EQ(step(other, 3, second), step(route, 3, second));
}

TEST_F(WayBack, IsNotTakenWhereTheCaseAsksForTheIterativeSolution) {
  solve::Model<3> model(with("iterative"));
  ChosenRoute<3> route(model, true, progress_);
  EXPECT_THROW(step(model, 2, rest_, [&](auto &&...numbers) { route.advance(numbers...); }),
               SolveError);
}

// Sizes 1/10, 1/40 and 1/10 again; the contact slips, charge leaks and an electrode discharges.
constexpr const char *rubbed = R"toml(
mesh.box = { min = [0, 0], max = [0.1, 0.1], cells = [6, 6] }
material.library = "BaTiO3-Liu2014"
time.interval = [{ until = 0.3, steps = 3 }, { until = 0.4, steps = 4 }, { until = 0.8, steps = 4 }]
boundary = [ { on = "right", displacement = [0, 0], potential = 0, temperature = 0 },
             { on = "top", traction = [0, "-50*t"] } ]
[contact]
on = "left"
friction = { law = "coulomb", cohesion = 5, coefficient = { static = 0.3, kinetic = 0.2, distance = 1e-9 } }
heat = { law = "insulated", friction_share = 0.5 }
electric = { law = "leak", coefficient = 1e-8, foundation_potential = 3 }
)toml";

State step(solve::Model<2> &model, ChosenRoute<2> &route, int n, const State &before) {
  route.begin_step(n);
  State right_side(model.n_unknowns(), 0.), next = before;
  model.loads.integrate(model.time(n), right_side);
  body::add_history<2>(model.products_by_field(before, false), right_side);
  route.advance(n, right_side, before, next);
  return next;
}

struct WhatWasKept {
  output::SavedNumbers last;
  int factorisations = 0, factorisations_anew = 0;
  int columns = 0, columns_anew = 0;  // of the contact's matrix
};

// A new route has made everything anew; the other one has kept what it could.
WhatWasKept expect_same_bits(const casefile::Case &asked, bool iteratively) {
  output::Progress progress{11, 1, true};
  solve::Model<2> one(asked), other(asked);
  ChosenRoute<2> kept(one, iteratively, progress);
  std::optional<ChosenRoute<2>> made;
  WhatWasKept of_all;
  State here(one.n_unknowns(), 0.), there = here;
  for (int n = 1; n <= one.steps.count(); ++n) {
    of_all.last = {};
    if (made)
      made->save(of_all.last);
    const bool goes_on = made.has_value();
    made.emplace(other, iteratively, progress, n);
    if (goes_on)
      made->restore(of_all.last);
    here = step(one, kept, n, here);
    there = step(other, *made, n, there);
    EXPECT_EQ(here, there) << "step " << n;
  }
  of_all.factorisations = kept.report(one.steps.sizes(3)).factorisations;
  of_all.factorisations_anew = made->report(other.steps.sizes(3)).factorisations;
  of_all.columns = kept.route().report().contact_columns;
  of_all.columns_anew = made->route().report().contact_columns;
  return of_all;
}

class SeveralSizes : public ::testing::TestWithParam<const char *> {
 protected:
  static casefile::Case asked() { return casefile::read_text(rubbed, "rubbed.toml", {GetParam()}); }

  output::Progress progress_{11, 1, true};
};

TEST_P(SeveralSizes, GoOnToTheSameBitsWhateverWasKept) {
  const WhatWasKept of_all =
      expect_same_bits(asked(), GetParam() == std::string("solver.body=iterative"));
  EXPECT_EQ(of_all.factorisations, of_all.factorisations_anew);
}

TEST(ContactsMatrix, OnceItWasNeededIsHandedOn) {
  const std::string text = verified::leaning_body(
      "time.interval = [{ until = 1, steps = 4 }, { until = 2, steps = 2 }]");
  const WhatWasKept of_all =
      expect_same_bits(casefile::read_text(text, "leaning.toml", {"solver.body=iterative"}), true);
  EXPECT_EQ(of_all.last.size("contact matrix"), 100U);  // 5 nodes in the plane
  EXPECT_EQ(of_all.columns, 10);
  EXPECT_EQ(of_all.columns_anew, of_all.columns);
}

TEST_P(SeveralSizes, AreReportedTogether) {
  solve::Model<2> model(asked());
  const bool iteratively = GetParam() == std::string("solver.body=iterative");
  ChosenRoute<2> route(model, iteratively, progress_);
  State state(model.n_unknowns(), 0.);
  std::size_t krylov = 0;
  int factorisations = 0, preconditioners = 0;
  double seconds = 0, condense_seconds = 0;
  for (int n = 1; n <= model.steps.count(); ++n) {
    state = step(model, route, n, state);
    const solve::RouteReport now = route.report(model.steps.sizes(n));
    EXPECT_GE(now.krylov_iterations, krylov);
    EXPECT_GE(now.factorisations, factorisations);
    EXPECT_GE(now.substitution_seconds, seconds);
    EXPECT_GE(now.condense_seconds, condense_seconds);
    EXPECT_GE(now.preconditioners, preconditioners);
    krylov = now.krylov_iterations;
    factorisations = now.factorisations;
    seconds = now.substitution_seconds;
    condense_seconds = now.condense_seconds;
    preconditioners = now.preconditioners;
  }
  if (GetParam() == std::string("solver.body=direct")) {
    EXPECT_EQ(factorisations, 2);
  }
  if (iteratively) {
    EXPECT_GE(preconditioners, model.steps.sizes(model.steps.count()));
  }
}

INSTANTIATE_TEST_SUITE_P(OnAllRoutes, SeveralSizes,
                         ::testing::Values("solver.body=direct", "solver.body=iterative",
                                           "solver.method=monolithic"));

}  // namespace
}  // namespace tourmaline::run
