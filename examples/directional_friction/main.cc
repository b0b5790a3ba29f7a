// A friction law of one's own: a foundation with a nap, like that of skis or of a brush motor. Slip
// along the nap, towards greater y, meets less friction than slip against it:
//
//     -against <= lambda_y <= along,   lambda = -sigma_tau
//
// A program of this kind needs the law, which stands here whole, and one call.
#include <tourmaline/case/reader.h>
#include <tourmaline/error.h>
#include <tourmaline/mesh/gmsh.h>
#include <tourmaline/run/simulation.h>

#include <algorithm>
#include <exception>
#include <iostream>
#include <memory>

namespace contact = tourmaline::contact;
using contact::Tangent;
using contact::TangentMatrix;

/// In two dimensions a point slips along one line: everything has one component.
class Nap : public contact::FrictionLaw {
 public:
  /// Bounds of lambda [N/m^2], for slip in the sense of the one component and opposite to it.
  Nap(double forwards, double backwards) : forwards_(forwards), backwards_(backwards) {}

  double dissipation(const Tangent &d) const override {
    return d[0] > 0 ? forwards_ * d[0] : -backwards_ * d[0];
  }
  Tangent traction(const Tangent &trial) const override {
    return Tangent::Constant(1, std::clamp(trial[0], -backwards_, forwards_));
  }
  TangentMatrix traction_derivative(const Tangent &trial) const override {
    return TangentMatrix::Constant(1, 1, sticks(trial) ? 1 : 0);
  }
  tourmaline::ContactStatus status(const Tangent &trial) const override {
    using tourmaline::ContactStatus;
    return sticks(trial) ? ContactStatus::stick : ContactStatus::slip;
  }
  bool is_smooth_at(const Tangent &d) const override { return d[0] != 0; }
  Tangent gradient(const Tangent &d) const override {
    return Tangent::Constant(1, d[0] > 0 ? forwards_ : -backwards_);
  }
  TangentMatrix hessian(const Tangent &) const override { return TangentMatrix::Zero(1, 1); }

 private:
  bool sticks(const Tangent &trial) const {
    return -backwards_ <= trial[0] && trial[0] <= forwards_;
  }

  double forwards_, backwards_;
};

constexpr double along = 5, against = 15;  // N/m^2

// Which sense of its line a point counts as positive, `directions` says.
contact::Friction nap_at(const contact::ContactPlace &place) {
  if (place.directions.cols() != 1)
    throw tourmaline::CaseError("a nap is a law for plane bodies, and this one is solid");
  const bool is_up = place.directions(1, 0) > 0;
  return contact::OwnLaw{is_up ? std::make_shared<Nap>(along, against)
                               : std::make_shared<Nap>(against, along)};
}

int main(int argc, char **argv) {
  if (argc != 3) {
    std::cerr << "directional_friction CASE.toml DIR\n";
    return 2;
  }
  try {
    const auto asked =
        tourmaline::casefile::read_file(argv[1], {}, tourmaline::mesh::read_mesh_file);
    tourmaline::run::simulate(
        asked, argv[2],
        {.friction = nap_at, .friction_name = "nap, 5 N/m^2 along, 15 N/m^2 against"});
  } catch (const std::exception &error) {
    std::cerr << "directional_friction: " << error.what() << '\n';
    return 1;
  }
}
