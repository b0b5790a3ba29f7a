// Label: analytic. Contacts beside each other: each has its own laws, and what is said in several
// entries is what one says.

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <set>

#include "closed_balances.h"
#include "contact_status.h"
#include "equal_quantities.h"
#include "run_case.h"

namespace tourmaline::verified {
namespace {

/// Squares of a grid as a mesh in Gmsh's format, the sides of the body in groups of given names.
class Squares {
 public:
  void add(int i_begin, int i_end, int j_begin, int j_end) {
    for (int i = i_begin; i < i_end; ++i)
      for (int j = j_begin; j < j_end; ++j)
        cells_.insert({i, j});
  }

  /// `name_of` gets twice the place of a side's middle, in sides of squares.
  void write(const std::filesystem::path &file, double h,
             const std::function<std::string(int, int)> &name_of) const {
    std::map<std::pair<int, int>, int> nodes;
    std::map<std::string, int> groups;
    std::string elements;
    int n = 0;
    const auto node = [&](int i, int j) {
      return nodes.try_emplace({i, j}, static_cast<int>(nodes.size()) + 1).first->second;
    };
    const auto line = [&](int i, int j, int to_i, int to_j) {
      const int group =
          groups.try_emplace(name_of(i + to_i, j + to_j), static_cast<int>(groups.size()) + 2)
              .first->second;
      elements +=
          fmt::format("{} 1 2 {} {} {} {}\n", ++n, group, group, node(i, j), node(to_i, to_j));
    };
    for (const auto &[i, j] : cells_) {
      elements += fmt::format("{} 3 2 1 1 {} {} {} {}\n", ++n, node(i, j), node(i + 1, j),
                              node(i + 1, j + 1), node(i, j + 1));
      if (!cells_.contains({i, j - 1}))
        line(i, j, i + 1, j);
      if (!cells_.contains({i, j + 1}))
        line(i, j + 1, i + 1, j + 1);
      if (!cells_.contains({i - 1, j}))
        line(i, j, i, j + 1);
      if (!cells_.contains({i + 1, j}))
        line(i + 1, j, i + 1, j + 1);
    }
    std::ofstream out(file);
    out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n"
        << groups.size() + 1 << "\n2 1 \"body\"\n";
    for (const auto &[name, number] : groups)
      out << "1 " << number << " \"" << name << "\"\n";
    out << "$EndPhysicalNames\n$Nodes\n" << nodes.size() << "\n";
    for (const auto &[place, number] : nodes)
      out << fmt::format("{} {} {} 0\n", number, h * place.first, h * place.second);
    out << "$EndNodes\n$Elements\n" << n << "\n" << elements << "$EndElements\n";
  }

 private:
  std::set<std::pair<int, int>> cells_;
};

const std::vector<Quantity> of_nodes{{"u_x", "u_y"}, {"potential"}, {"temperature"}};
const std::vector<Quantity> of_contact{
    {"normal_traction", "tangential_traction_x", "tangential_traction_y"},
    {"slip_x", "slip_y", "normal_displacement", "gap"},
    {"slip_rate"},
    {"temperature"},
    {"potential"},
    {"heat_flux"}};

/// The rows of which a column has that value.
Table rows_with(const Table &table, const std::string &column, const std::string &value) {
  Table some;
  for (const auto &[name, cells] : table.columns) {
    some.columns[name];
    for (std::size_t i = 0; i < cells.size(); ++i)
      if (table.columns.at(column)[i] == value)
        some.columns[name].push_back(cells[i]);
  }
  return some;
}

void expect_same_contact(const Table &one, const Table &other, double tolerance = 1e-9) {
  ASSERT_EQ(one.n_rows(), other.n_rows());
  expect_equal_quantities(one, other, of_contact, tolerance);
  EXPECT_EQ(one.columns.at("status"), other.columns.at("status"));
}

struct Laws {
  std::string words, solver;
};
void PrintTo(const Laws &laws, std::ostream *out) {
  *out << laws.words << " " << laws.solver;
}

const std::string tresca = R"toml(
friction = { law = "tresca", bound = "1e5*(1 + 50*x)" }
)toml";
const std::string coulomb = R"toml(
gap = "3e-3*(x - 0.008)^2"
normal = "unilateral"
friction = { law = "coulomb", coefficient = { static = 0.35, kinetic = 0.3, distance = 1e-6 } }
)toml";
/// Each law on each route.
std::vector<Laws> on_every_route(const std::vector<std::string> &laws) {
  std::vector<Laws> all;
  for (const std::string &words : laws)
    for (const char *solver :
         {"solver.body=direct", "solver.method=monolithic", "solver.body=iterative"})
      all.push_back({words, solver});
  return all;
}
const std::string exchange =
    "heat = { law = \"exchange\", coefficient = \"2e4*(1 + 20*x)\", foundation_temperature = "
    "\"20*t\" }\n";

// 1. One contact in parts.

// The bottom in two parts that meet in the middle, where the node belongs to the first.
void expect_parts_are_the_contact(const std::string &body, const std::string &words,
                                  const std::string &solver) {
  const output::TemporaryFolder folder;
  Squares mesh;
  mesh.add(0, 12, 0, 6);
  mesh.write(folder / "body.msh", 0.02 / 12, [](int i, int j) {
    return std::string(j == 12 ? "top" : j > 0 ? "side" : i < 10 ? "near" : "far");
  });
  const std::string law = "foundation_displacement = [\"5e-7*sin(4*t)\", 0]\n" + words + exchange;
  const auto run = [&](const std::string &contacts) {
    return run_text(body + contacts, {solver}, folder.path());
  };
  const RunCase whole = run("[contact]\non = [\"near\", \"far\"]\n" + law),
                parts = run("[[contact]]\non = \"near\"\n" + law + "[[contact]]\nname = \"b\"\n" +
                            "on = \"far\"\n" + law);
  expect_equal_quantities(parts.nodes(), whole.nodes(), of_nodes);
  expect_same_contact(parts.contact(), whole.contact());
  EXPECT_TRUE(has_status(whole.contact(), "slip"));
  expect_closed_balances(parts.history());
  const Table one = whole.history(), two = parts.history();
  for (const char *column :
       {"contact_force_x", "contact_force_y", "friction_dissipation", "foundation_power",
        "contact_moment_z", "stick", "slip", "open", "conduction_loss"})
    EXPECT_LE(difference(two, one, column), 1e-9) << column;
  for (const std::string column :
       {"contact_force_x", "contact_force_y", "contact_moment_z", "stick", "slip", "open"}) {
    const std::vector<double> all = one.numbers(column), near = two.numbers(column + "_near"),
                              far = two.numbers(column + "_b");
    for (std::size_t i = 0; i < all.size(); ++i)
      EXPECT_NEAR(near[i] + far[i], all[i], 1e-9 * largest(all)) << column;
  }
  const Table rows = parts.contact();
  const std::vector<double> x = rows.numbers("x");
  for (std::size_t i = 0; i < x.size(); ++i)
    EXPECT_EQ(rows.columns.at("contact")[i], x[i] < 0.02 * 5.1 / 12 ? "near" : "b");
  EXPECT_FALSE(whole.contact().columns.contains("contact"));
  EXPECT_EQ(parts.summary().at("warnings").dump().find("edge"), std::string::npos);
}

class OneContactInParts : public ::testing::TestWithParam<Laws> {};

TEST_P(OneContactInParts, IsTheContact) {
  expect_parts_are_the_contact(R"toml(
mesh = { file = "body.msh" }
material = { library = "BaTiO3-Liu2014", pyroelectric = [0, 1e-4] }
time = { end = 1, steps = 4 }
boundary = [ { on = "top", displacement = ["5e-7*t", "-5e-7*t"], potential = 0, temperature = "2*t" } ]
)toml",
                               GetParam().words, GetParam().solver);
}

TEST_P(OneContactInParts, OfTwoMaterialsUnderAnElectrodeIsTheContact) {
  const bool is_direct = GetParam().solver == "solver.body=direct";
  expect_parts_are_the_contact(std::string(R"toml(
mesh = { file = "body.msh", degree = 2 }
time = { end = 1, steps = 4 }
region = [ { where = "y < 0.005", material = { library = "BaTiO3-Liu2014", pyroelectric = [0, 1e-4] } },
           { where = "y >= 0.005", material = { library = "BaTiO3-Liu2014", poling = [1, 1] } } ]
boundary = [ { on = "top", displacement = ["5e-7*t", "-5e-7*t"], temperature = "2*t" } ]
electrode = [ { name = "plate", on = "top", voltage = "10*t")toml") +
                                   (is_direct ? ", resistor = 1e7" : "") + " } ]\n",
                               GetParam().words, GetParam().solver);
}

INSTANTIATE_TEST_SUITE_P(Routes, OneContactInParts,
                         ::testing::ValuesIn(on_every_route({tresca, coulomb})));

// 2. Contacts that do not know of each other.

class TwoBlocks : public ::testing::TestWithParam<const char *> {};

// Two blocks, joined by a bridge that is one square high, so that all its nodes are held: neither
// block feels the other. Each has a contact with laws and a foundation of its own.
TEST_P(TwoBlocks, EachDoesWhatItDoesWithoutTheContactOfTheOther) {
  const output::TemporaryFolder folder;
  Squares mesh;
  mesh.add(0, 12, 0, 6);
  mesh.add(12, 15, 3, 4);
  mesh.add(15, 27, 0, 6);
  mesh.write(folder / "blocks.msh", 0.02 / 12, [](int i, int j) {
    const std::string block = i <= 24 ? "a" : "b";
    return i > 24 && i < 30 ? "bridge" : block + (j == 0 ? "bottom" : j == 12 ? "top" : "side");
  });
  const std::string body = R"toml(
mesh = { file = "blocks.msh" }
material = { library = "BaTiO3-Liu2014", pyroelectric = [0, 1e-4] }
time = { end = 1, steps = 4 }
boundary = [
  { on = "bridge", displacement = [0, 0], potential = 0, temperature = 0 },
  { on = "atop", displacement = ["5e-7*t", "-5e-7*t"], potential = 0, temperature = "2*t" },
  { on = "btop", displacement = ["4e-7*t^2", "-3e-7*t"], potential = "t", temperature = 0 },
]
)toml";
  const std::string contact_a = "[[contact]]\non = \"abottom\"\ngap = -1e-8\n" + tresca + exchange;
  const std::string contact_b = R"toml(
[[contact]]
on = "bbottom"
gap = "3e-3*(x - 0.033)^2"
foundation_displacement = ["5e-7*sin(4*t)", 0]
normal = "unilateral"
friction = { law = "coulomb", coefficient = 0.3 }
heat = { law = "exchange", coefficient = 5e3, foundation_temperature = -3 }
)toml";
  const auto run = [&](const std::string &contacts) {
    return run_text(body + contacts, {GetParam()}, folder.path());
  };
  const RunCase a = run(contact_a), b = run(contact_b), together = run(contact_b + contact_a);
  expect_same_contact(rows_with(together.contact(), "contact", "abottom"), a.contact());
  expect_same_contact(rows_with(together.contact(), "contact", "bbottom"), b.contact());
  for (const char *status : {"stick", "slip", "open"})
    EXPECT_TRUE(has_status(b.contact(), status)) << status;
  EXPECT_TRUE(has_status(a.contact(), "slip"));
  expect_closed_balances(together.history());
  const Table history = together.history();
  const auto expect_same_column = [&](const std::string &column, const RunCase &alone,
                                      const std::string &column_alone) {
    Table one, other;
    one.columns["it"] = history.columns.at(column);
    other.columns["it"] = alone.history().columns.at(column_alone);
    EXPECT_LE(difference(one, other, "it"), 1e-9) << column;
  };
  for (const std::string column : {"contact_force_x", "contact_force_y", "stick", "slip", "open"}) {
    expect_same_column(column + "_abottom", a, column);
    expect_same_column(column + "_bbottom", b, column);
  }
  expect_same_column("contact_heat_abottom", a, "heat_abottom");
  expect_same_column("contact_heat_bbottom", b, "heat_bbottom");
  expect_same_column("contact_moment_z_bbottom", b, "contact_moment_z");
  EXPECT_EQ(together.summary().at("contacts").at(0).at("name"), "bbottom");
  EXPECT_EQ(together.summary().at("contacts").at(1).at("nodes"), 13);
}

INSTANTIATE_TEST_SUITE_P(Routes, TwoBlocks,
                         ::testing::Values("solver.method=condensed", "solver.method=monolithic"));

// 3. Contacts that mirror each other.

class Mirrored : public ::testing::TestWithParam<Laws> {};

// A block between two jaws that close and are then drawn down; poled along the plane of symmetry.
void expect_mirrored(int dim, const std::string &normal_and_friction, const std::string &solver) {
  const std::string body = dim == 2 ? R"toml(
mesh.box = { min = [-0.01, 0], max = [0.01, 0.01], cells = [12, 6], cell = "quadrilateral" }
material = { library = "BaTiO3-Liu2014", pyroelectric = [0, 1e-4] }
boundary = [ { on = "bottom", displacement = ["free", 0], potential = 0 },
             { on = "top", traction = ["2e5*x*t", "-1e6*t"], temperature = "t" } ]
)toml"
                                    : R"toml(
mesh.box = { min = [-0.01, 0, 0], max = [0.01, 0.01, 0.01], cells = [6, 3, 4], cell = "hexahedron" }
material = { library = "BaTiO3-Liu2014", pyroelectric = [0, 0, 1e-4] }
boundary = [ { on = "bottom", displacement = ["free", 0, 0], potential = 0 },
             { on = "top", traction = [0, 0, "-1e6*t"], temperature = "0.3*t" } ]
)toml";
  const auto contact = [&](const std::string &on, const std::string &towards) {
    return "[[contact]]\non = \"" + on + "\"\nfoundation_displacement = [\"" + towards +
           "1e-7*(t + t^2)\", " + (dim == 3 ? "0, \"-3e-8*t^2\"]\n" : "\"-1e-7*t^2\"]\n") +
           normal_and_friction +
           "heat = { law = \"exchange\", coefficient = 1e3, foundation_temperature = \"5*t\" }\n";
  };
  const RunCase run = run_text(
      "time = { end = 1, steps = 4 }\n" + body + contact("left", "") + contact("right", "-"),
      {solver});
  const Table left = rows_with(run.contact(), "contact", "left"),
              right = rows_with(run.contact(), "contact", "right");
  std::vector<Quantity> same{{"normal_traction", "tangential_traction_y"},
                             {"slip_y", "normal_displacement", "gap"},
                             {"slip_rate"},
                             {"temperature"},
                             {"potential"},
                             {"heat_flux"}};
  if (dim == 3) {
    same.front().push_back("tangential_traction_z");
    same[1].push_back("slip_z");
  }
  ASSERT_EQ(left.n_rows(), right.n_rows());
  expect_equal_quantities(left, right, same);
  EXPECT_EQ(left.columns.at("status"), right.columns.at("status"));
  EXPECT_TRUE(has_status(left, "slip"));
  EXPECT_TRUE(has_status(left, "stick"));
  const Table history = run.history();
  const std::vector<double> push = history.numbers("contact_force_x_left"),
                            back = history.numbers("contact_force_x_right");
  EXPECT_GT(push.back(), 0);
  for (std::size_t i = 0; i < push.size(); ++i)
    EXPECT_NEAR(push[i], -back[i], 1e-9 * largest(push));
  expect_closed_balances(run.history());
}

TEST_P(Mirrored, DoTheMirroredThingInThePlane) {
  expect_mirrored(2, GetParam().words, GetParam().solver);
}

TEST_P(Mirrored, DoTheMirroredThingInSpace) {
  expect_mirrored(3, GetParam().words, GetParam().solver);
}

const std::string plain_coulomb =
    "normal = \"unilateral\"\nfriction = { law = \"coulomb\", coefficient = 0.3 }\n";
const std::string plain_tresca = "friction = { law = \"tresca\", bound = 3e5 }\n";

INSTANTIATE_TEST_SUITE_P(Routes, Mirrored,
                         ::testing::ValuesIn(on_every_route({plain_coulomb, plain_tresca})));

// 4. Heat.

// In the steady state as much flows through each foundation's film as through the body.
TEST(SeveralContacts, ExchangeHeatEachWithItsOwnFoundation) {
  const double length = 0.02, height = 0.01, conductivity = 50, k_left = 1e4, k_right = 3e3,
               hot = 7, cold = -4;
  for (const std::string solver :
       {"solver.body=direct", "solver.method=monolithic", "solver.body=iterative"}) {
    SCOPED_TRACE(solver);
    const RunCase run =
        run_text(fmt::format(R"toml(
mesh.box = {{ min = [0, 0], max = [{}, {}], cells = [8, 3], cell = "quadrilateral" }}
material = {{ symmetry = "isotropic", young = 200e9, poisson = 0.3, eps11 = 100, k11 = {}, density = 7800, specific_heat = 500, reference_temperature = 293 }}
time = {{ end = 1e6, steps = 3 }}
boundary = [ {{ on = "bottom", displacement = [0, 0], potential = 0 }} ]
contact = [ {{ on = "left", heat = {{ law = "exchange", coefficient = {}, foundation_temperature = {} }} }},
            {{ name = "cold", on = "right", heat = {{ law = "exchange", coefficient = {}, foundation_temperature = {} }} }} ]
)toml",
                             length, height, conductivity, k_left, hot, k_right, cold),
                 {solver});
    const double flow = (hot - cold) / (1 / k_left + length / conductivity + 1 / k_right);
    const Table history = run.history(), contact = run.contact();
    EXPECT_NEAR(history.numbers("contact_heat_left").back(), -flow * height, 1e-8 * flow * height);
    EXPECT_NEAR(history.numbers("contact_heat_cold").back(), flow * height, 1e-8 * flow * height);
    const Table left = rows_with(contact, "contact", "left"),
                right = rows_with(contact, "contact", "cold");
    EXPECT_NEAR(left.numbers("heat_flux").back(), -flow, 1e-8 * flow);
    EXPECT_NEAR(right.numbers("heat_flux").back(), flow, 1e-8 * flow);
    EXPECT_NEAR(left.numbers("temperature").back(), hot - flow / k_left, 1e-8);
    EXPECT_NEAR(right.numbers("temperature").back(), cold + flow / k_right, 1e-8);
  }
}

// A node where contacts meet is the first one's.
TEST(SeveralContacts, OfWhichOneHasNoNodeOfItsOwnAreRefused) {
  const auto run = [] {
    run_text(R"toml(
mesh.box = { min = [0, 0], max = [1, 1], cells = [1, 1], cell = "quadrilateral" }
material.library = "steel"
model = { thermal = false, electric = false }
time = { end = 1, steps = 1 }
boundary = [ { on = "top", displacement = ["free", 1e-6] } ]
contact = [ { on = ["left", "right"] }, { name = "sole", on = "bottom", normal = "unilateral" } ]
)toml",
             {});
  };
  EXPECT_THAT(run, ::testing::ThrowsMessage<CaseError>(::testing::HasSubstr(
                       "[contact] on \"bottom\": contacts before it have all of its nodes")));
}

// 5. Laws of different kinds.

// The wall is bilateral with Tresca's law, the jaw opens and rubs by its pressure.
TEST(SeveralContacts, OfDifferentLawsAreTheSameOnBothRoutes) {
  const std::string file = "cases/clamped-block/block.toml";
  const RunCase condensed(file), monolithic(file, {"solver.method=monolithic"});
  expect_equal_quantities(condensed.nodes(), monolithic.nodes(), of_nodes, 1e-8);
  expect_same_contact(condensed.contact(), monolithic.contact(), 1e-8);
  expect_equal_quantities(condensed.contact(), monolithic.contact(), {{"friction_bound"}}, 1e-8);
  expect_closed_balances(condensed.history());
  expect_closed_balances(monolithic.history());
  const Table wall = rows_with(condensed.contact(), "contact", "wall"),
              jaw = rows_with(condensed.contact(), "contact", "jaw");
  for (const Table &contact : {wall, jaw}) {
    EXPECT_TRUE(has_status(contact, "stick"));
    EXPECT_TRUE(has_status(contact, "slip"));
  }
  for (const std::string &bound : wall.columns.at("friction_bound"))
    EXPECT_EQ(std::stod(bound), 2e5);
  const std::vector<double> bound = jaw.numbers("friction_bound"),
                            normal = jaw.numbers("normal_traction");
  for (std::size_t i = 0; i < bound.size(); ++i)
    EXPECT_NEAR(bound[i], 0.15 * std::max(0., -normal[i]), 1e-9 * largest(bound));
}

// The jaw moves as one body, the wall rests; weights of squares are their sides' halves.
TEST(SeveralContacts, EachHaveTheirOwnWorkAndFriction) {
  const double side = 0.01 / 16;
  for (const std::string solver : {"solver.method=condensed", "solver.method=monolithic"}) {
    SCOPED_TRACE(solver);
    const RunCase run("cases/clamped-block/block.toml", {solver});
    const Table history = run.history(), contact = run.contact();
    const std::vector<double> time = history.numbers("time"),
                              force = history.numbers("contact_force_x_jaw"),
                              of_jaw = history.numbers("foundation_power_jaw"),
                              of_wall = history.numbers("foundation_power_wall"),
                              of_all = history.numbers("foundation_power");
    const auto moved = [](double t) { return -2e-7 * (1 - std::exp(-8 * t)); };
    for (std::size_t i = 0; i < time.size(); ++i) {
      const double k = 0.05, before = time[i] - k;
      EXPECT_NEAR(of_jaw[i], force[i] * (moved(time[i]) - moved(before)) / k,
                  1e-12 * largest(of_jaw));
      EXPECT_EQ(of_wall[i], 0);
      EXPECT_EQ(of_all[i], of_jaw[i] + of_wall[i]);
    }
    for (const std::string name : {"wall", "jaw"}) {
      const Table rows = rows_with(rows_with(contact, "contact", name), "step", "20");
      const std::vector<double> y = rows.numbers("y"),
                                traction = rows.numbers("tangential_traction_y"),
                                rate = rows.numbers("slip_rate");
      double dissipated = 0;
      for (std::size_t i = 0; i < y.size(); ++i)
        dissipated +=
            (y[i] < 1e-9 || y[i] > 0.01 - 1e-9 ? 0.5 : 1) * side * std::abs(traction[i]) * rate[i];
      EXPECT_GT(dissipated, 0);
      EXPECT_NEAR(history.numbers("friction_dissipation_" + name).back(), dissipated,
                  1e-9 * dissipated);
      EXPECT_EQ(history.numbers("contact_energy_" + name).back(), 0);
    }
  }
}

TEST(SeveralContacts, WithTrescasLawEachAreTheSameOnTheIterativeRoute) {
  const std::string file = "cases/clamped-block/block.toml";
  std::vector<std::string> overrides{"boundary[0].displacement=['free', 0]",
                                     "contact[1].normal=bilateral",
                                     "contact[1].friction={law='tresca', bound=1e5}"};
  const RunCase direct(file, overrides);
  overrides.push_back("solver.body=iterative");
  const RunCase iterative(file, overrides);
  expect_equal_quantities(iterative.nodes(), direct.nodes(), of_nodes, 1e-8);
  expect_same_contact(iterative.contact(), direct.contact(), 1e-8);
  EXPECT_TRUE(has_status(rows_with(direct.contact(), "contact", "jaw"), "slip"));
}

// 6. Edges.

// The corner at (0, 0) belongs to the contact that is named first, and the other has none of it.
TEST(SeveralContacts, ThatMeetAtAnEdgeLeaveItToTheFirst) {
  for (const std::string solver : {"solver.method=condensed", "solver.method=monolithic"}) {
    SCOPED_TRACE(solver);
    const RunCase run = run_text(R"toml(
mesh.box = { min = [0, 0], max = [0.02, 0.01], cells = [8, 4], cell = "quadrilateral" }
material.library = "BaTiO3-Liu2014"
time = { end = 1, steps = 3 }
boundary = [ { on = "top", traction = ["-1e5*t", "-1e6*t"], potential = 0, temperature = 0 } ]
[[contact]]
on = "bottom"
normal = "unilateral"
friction = { law = "coulomb", coefficient = 0.2 }
[[contact]]
on = "left"
friction = { law = "tresca", bound = 1e4 }
)toml",
                                 {solver});
    const Table contact = run.contact();
    const std::vector<double> x = contact.numbers("x"), y = contact.numbers("y");
    EXPECT_EQ(contact.n_rows(), 3 * (9 + 4));
    for (std::size_t i = 0; i < x.size(); ++i)
      EXPECT_EQ(contact.columns.at("contact")[i], y[i] == 0 ? "bottom" : "left");
    EXPECT_EQ(contact.numbers("tangential_traction_y").front(), 0);
    expect_closed_balances(run.history());
    ASSERT_EQ(run.summary().at("warnings").size(), 1u);
    EXPECT_NE(run.summary()
                  .at("warnings")
                  .at(0)
                  .get<std::string>()
                  .find("contacts meet at an edge, at (0, 0, 0)"),
              std::string::npos);
  }
}

}  // namespace
}  // namespace tourmaline::verified
