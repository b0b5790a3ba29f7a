#include "contact/checked_law.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <new>
#include <stdexcept>

#include "ellipse.h"
#include "tangents.h"
#include "tourmaline/error.h"

namespace tourmaline::contact {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Tresca's law in which one answer is replaced.
struct Spoilt : FrictionLaw {
  explicit Spoilt(double bound) : law{bound} {}

  double dissipation(const Tangent &d) const override {
    return work ? work(d) : law.dissipation(d);
  }
  Tangent traction(const Tangent &x) const override { return answer ? answer(x) : law.traction(x); }
  TangentMatrix traction_derivative(const Tangent &x) const override {
    return matrix ? matrix(x) : law.traction_derivative(x);
  }
  ContactStatus status(const Tangent &x) const override { return said ? *said : law.status(x); }
  bool is_smooth_at(const Tangent &d) const override { return law.is_smooth_at(d); }
  Tangent gradient(const Tangent &d) const override { return slope ? slope(d) : law.gradient(d); }
  TangentMatrix hessian(const Tangent &d) const override {
    return matrix ? matrix(d) : law.hessian(d);
  }

  Tresca law;
  std::function<double(const Tangent &)> work;
  std::function<Tangent(const Tangent &)> answer, slope;
  std::function<TangentMatrix(const Tangent &)> matrix;
  std::optional<ContactStatus> said;
};

OwnLaw checked_as(Friction law) {
  const ContactPlace place{{1, 2, 3}, 0.5, {}};
  return std::get<OwnLaw>(checked([law](const ContactPlace &) { return law; }, "mine")(place));
}

auto refused(const std::string &text) {
  return ThrowsMessage<CaseError>(
      AllOf(HasSubstr("the friction law \"mine\" at (1, 2, 3), t = 0.5 s"), HasSubstr(text)));
}

class ACheckedLaw : public ::testing::Test {
 protected:
  std::shared_ptr<Spoilt> spoilt_ = std::make_shared<Spoilt>(5);
  OwnLaw law_ = checked_as(OwnLaw{spoilt_});
};

TEST_F(ACheckedLaw, AnswersAsTheLawDoesWithOneAndTwoComponents) {
  const Tresca tresca{5};
  for (const Tangent &x : {plane(3, 4), plane(30, -40), plane(0, 0),
                           Tangent(Tangent::Constant(1, 7)), Tangent(Tangent::Constant(1, -5))}) {
    EXPECT_EQ(law_.law->traction(x), tresca.traction(x));
    EXPECT_EQ(law_.law->traction_derivative(x), tresca.traction_derivative(x));
    EXPECT_EQ(law_.law->status(x), tresca.status(x));
    EXPECT_EQ(law_.law->dissipation(x), tresca.dissipation(x));
    if (tresca.is_smooth_at(x)) {
      EXPECT_EQ(law_.law->gradient(x), tresca.gradient(x));
      EXPECT_EQ(law_.law->hessian(x), tresca.hessian(x));
    }
  }
}

TEST_F(ACheckedLaw, MustHaveAsManyComponentsAsItIsAskedFor) {
  spoilt_->answer = spoilt_->slope = [](const Tangent &) { return Tangent::Constant(1, 1.); };
  spoilt_->matrix = [](const Tangent &) { return TangentMatrix::Zero(1, 2); };
  EXPECT_THAT([&] { law_.law->traction(plane(3, 4)); },
              refused("traction((3, 4)) has 1 components, and must have 2"));
  EXPECT_THAT([&] { law_.law->gradient(plane(3, 4)); },
              refused("gradient((3, 4)) has 1 components"));
  EXPECT_THAT([&] { law_.law->traction_derivative(plane(3, 4)); },
              refused("has 1 rows and 2 columns, and must have 2 of both"));
  EXPECT_THAT([&] { law_.law->hessian(plane(3, 4)); }, refused("hessian((3, 4)) has 1 rows"));
}

TEST_F(ACheckedLaw, MustAnswerFiniteNumbers) {
  spoilt_->answer =
      spoilt_->slope = [](const Tangent &x) { return Tangent(Tangent::Constant(x.size(), nan)); };
  spoilt_->matrix = [](const Tangent &) {
    return TangentMatrix(TangentMatrix::Constant(2, 2, nan));
  };
  for (const double work : {nan, -1., HUGE_VAL}) {
    spoilt_->work = [work](const Tangent &) { return work; };
    EXPECT_THAT([&] { law_.law->dissipation(plane(3, 4)); }, refused("must be finite and >= 0"));
  }
  EXPECT_THAT([&] { law_.law->traction(plane(3, 4)); }, refused("no finite number"));
  EXPECT_THAT([&] { law_.law->gradient(plane(3, 4)); }, refused("no finite number"));
  EXPECT_THAT([&] { law_.law->hessian(plane(3, 4)); }, refused("no finite number"));
  EXPECT_THAT([&] { law_.law->traction_derivative(plane(3, 4)); }, refused("no finite number"));
}

TEST_F(ACheckedLaw, IsNotBlamedForWhatTheBodyBrings) {
  EXPECT_NO_THROW(law_.law->traction(plane(nan, 1)));
  EXPECT_NO_THROW(law_.law->dissipation(plane(nan, 1)));
  EXPECT_NO_THROW(law_.law->status(plane(nan, 1)));
}

TEST_F(ACheckedLaw, MustHaveTheStatusOfItsTraction) {
  spoilt_->said = ContactStatus::stick;
  EXPECT_EQ(law_.law->status(plane(3, 3.9)), ContactStatus::stick);
  EXPECT_THAT([&] { law_.law->status(plane(30, 40)); },
              refused("is stick, but traction of the same"));
  spoilt_->said = ContactStatus::slip;
  EXPECT_EQ(law_.law->status(plane(30, 40)), ContactStatus::slip);
  EXPECT_THAT([&] { law_.law->status(plane(3, 3.9)); }, refused("is slip, but traction leaves"));
  EXPECT_EQ(law_.law->status(plane(3, 4)), ContactStatus::slip) << "on the border either";
  spoilt_->said = ContactStatus::open;
  EXPECT_THAT([&] { law_.law->status(plane(3, 4)); }, refused("is neither stick nor slip"));
}

TEST_F(ACheckedLaw, MustBePositivelyHomogeneous) {
  spoilt_->work = [](const Tangent &d) { return 5 * d.squaredNorm(); };
  EXPECT_THAT([&] { law_.law->gradient(plane(3, 4)); }, refused("positively homogeneous"));
  spoilt_->work = nullptr;
  spoilt_->slope = [](const Tangent &d) { return Tangent(-5 * d.normalized()); };
  EXPECT_THAT([&] { law_.law->gradient(plane(3, 4)); }, refused("positively homogeneous"));
}

TEST_F(ACheckedLaw, ThatThrowsIsNamedUnlessItThrowsThisLibrarysErrors) {
  spoilt_->answer = [](const Tangent &) -> Tangent { throw std::out_of_range("no such row"); };
  EXPECT_THAT([&] { law_.law->traction(plane(3, 4)); },
              refused("traction threw an exception: no such row"));
  spoilt_->answer = [](const Tangent &) -> Tangent { throw 42; };
  EXPECT_THAT([&] { law_.law->traction(plane(3, 4)); }, refused("traction threw an exception"));
  spoilt_->answer = [](const Tangent &) -> Tangent { throw SolveError("as it is"); };
  EXPECT_THAT([&] { law_.law->traction(plane(3, 4)); }, ThrowsMessage<SolveError>("as it is"));
  spoilt_->answer = [](const Tangent &) -> Tangent { throw std::bad_alloc(); };
  EXPECT_THROW(law_.law->traction(plane(3, 4)), std::bad_alloc);
}

TEST(CheckedLaws, MustBeThere) {
  EXPECT_THAT([] { checked_as(OwnLaw{}); }, refused("its OwnLaw is empty"));
  EXPECT_THAT([] { checked([](const ContactPlace &) -> Friction { throw 1; }, "mine")({}); },
              ThrowsMessage<CaseError>(HasSubstr("the function that gives the law threw")));
}

TEST(CheckedLaws, OfTrescasKindHaveAFiniteBound) {
  for (const double bound : {-1., nan, HUGE_VAL})
    EXPECT_THAT([&] { checked_as(Tresca{bound}); }, refused("it must be finite and >= 0"));
}

/// The status that follows from the traction, where a law does not say its own.
TEST(FrictionLaw, SticksWhereItsTractionIsTheTrialValue) {
  struct Plain : verified::Ellipse {
    using Ellipse::Ellipse;
    ContactStatus status(const Tangent &x) const override { return FrictionLaw::status(x); }
  };
  const Plain law(Eigen::Vector2d(4, 1).asDiagonal().toDenseMatrix());
  EXPECT_EQ(law.status(plane(1.9, 0)), ContactStatus::stick);
  EXPECT_EQ(law.status(plane(2.1, 0)), ContactStatus::slip);
  EXPECT_EQ(law.status(plane(0, 1.1)), ContactStatus::slip);
}

}  // namespace
}  // namespace tourmaline::contact
