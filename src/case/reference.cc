#include "case/reference.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>
#include <vector>

#include "case/schema.h"
#include "case/toml_text.h"
#include "tourmaline/case/case.h"

namespace tourmaline::casefile {

namespace {

constexpr std::string_view introduction = R"(# The case file

A case file says what is simulated. It is [TOML](https://toml.io); `cases/` holds examples. This page is
printed by `tourmaline reference` from the declarations that the program reads with
(`src/case/schema*.cc`).

All values are SI. Where a key has a unit, a text may give its number with another unit of the same kind:
`"5 kPa"`, `"0.5 mm"`, `"120 V"`, `"3 N/mm^2"`, `"27 degC"` as in [Units](#units). Temperatures are differences to the
reference temperature. Unknown keys, wrong types
and impossible values are errors that say the place and what is allowed. "At most ... in size" and "from ... to ... in
size" hold for numbers other than 0 without their sign; they are orders of magnitude beyond materials and devices, so that
what lies outside is a slip. `tourmaline check CASE.toml`
prints the complete case with all defaults filled in; that text is itself a case file.

[case.schema.json](case.schema.json), printed by `tourmaline schema`, is the same as JSON Schema (draft
2020-12): with it editors complete keys and show units, ranges and mistakes. In editors with Taplo (Even Better
TOML in Visual Studio Code) the first line of a case names it: `#:schema case.schema.json`, a path from the
case or a URL. It accepts every valid case and refuses wrong names, types, ranges, choices and lengths, and keys
that the others give no meaning. Only `tourmaline check` sees what depends on formulas, mesh files, materials and
sums, and that `2.0` is no integer. Its `version` (also in `$id`) is raised when a case that it accepted is no
longer accepted or means something else; new keys and values do not raise it.

`--set key.path=value` replaces any key from the command line, the value as TOML; what is not TOML is a
text: `--set time.steps=40 --set mesh.box.cells=[32,32] --set solver.method=monolithic`. Entries of lists
are counted from 0, `--set "boundary[2].traction=[0,'-1*t']"`, or go by their `name`, or where they have none by what
they are `on`, joined by +: `--set "electrode[drive].voltage=5"`, `--set "boundary[top].traction=[0,-1]"`.

## Formulas

Where the type below is *formula*, a number or a text such as `"-0.5*t"` stands. Operators are
`+ - * / ^`, the comparisons `== != < > <= >=`, `&&`, `||` and `c ? a : b`.

)";

std::string code_list(const std::vector<std::string> &names) {
  std::string all;
  for (const std::string &name : names)
    all += (all.empty() ? "`" : ", `") + name + "`";
  return all;
}

constexpr const char *units = R"(
## Units

A text of a number and a unit stands for a number wherever the tables below have a unit, in lists and in points over t
too: `traction = [0, "-5 kPa"]`, `end = "20 ms"`, `--set "boundary[0].potential=1.5 kV"`. The names of units are those
of UDUNITS: SI's symbols and prefixes (`um` or `µm`, `ohm` or `Ω`), `min`, `h`, `bar`, `psi`, `in`, `degC` and many
more; products with a space or `.`, quotients with `/`, powers as `m^2`, `m2` or `m²`. `tourmaline check` and
resolved.toml have the numbers in SI. A unit of another kind is a mistake, and so is `degC` for a temperature other than
`reference_temperature`: all others are differences, in K. `mesh.size` without a unit is in that of the mesh's file; in a
plane body an electrode's charge, resistance and capacitance are in `C/m`, `ohm m` and `F/m`. In a formula numbers have
no units.
)";

constexpr const char *tables = R"(
Where a formula may depend on t, a table of values over t may stand instead, as of what was measured:

    traction = [0, { table = "load.csv", column = "F" }]       # a column of a file, its place from the case's folder
    voltage = { points = [[0, 0], [1e-3, 100], [2e-3, 0]] }    # [t, value], t in s

The file's first column is t; a first line that is no numbers names the columns, commas, semicolons or tabs part
them, and lines that begin with # do not count. Without `column` the second one is taken. Between two points the
value is linear; t must ascend, and the points must span the whole run from 0 to its end: what is outside them
nobody has said. resolved.toml has the points, so that it runs without the file, and a run whose points have changed is
another case for `--resume`.
)";

std::string formulas() {
  const FormulaNames &names = formula_names();
  return fmt::format(
             "- variables: {} (place [m] and time [s]; no `z` in two dimensions)\n- constants: "
             "{}\n- "
             "functions: {}\n\n"
             "`if(c, a, b)` is `c ? a : b`, `log` and `ln` are the natural logarithm, `mod(a, b)` "
             "has the "
             "sign of b.\nOf `if`, `?:`, `&&` and `||` only what decides is evaluated. A formula "
             "in which "
             "any "
             "value that is evaluated is infinite or not a\nnumber ends the run with an error, as "
             "does "
             "one "
             "whose value is not in the range of its key.\n",
             code_list(names.variables), code_list(names.constants), code_list(names.functions)) +
         tables;
}

struct TypeName {
  const Key &key;

  std::string operator()(const bool *) const { return "true or false"; }
  std::string operator()(const int *) const { return "integer"; }
  std::string operator()(const double *) const { return "number"; }
  std::string operator()(const std::string *) const { return "text"; }
  std::string operator()(const std::vector<std::string> *) const { return "text or list of texts"; }
  std::string operator()(const std::vector<int> *) const { return "list of integers"; }
  std::string operator()(const std::vector<double> *) const { return "list of numbers"; }
  std::string operator()(const Matrix *) const {
    return fmt::format("{} rows of {} numbers", key.rows, key.length.counts.front());
  }
  std::string operator()(const Formula *) const { return "formula"; }
  std::string operator()(const FormulaVector *) const { return "list of formulas"; }
  std::string operator()(const Displacement *) const { return "list of formulas or \"free\""; }
};

/// A row for each key, then the tables inside.
class Page : public Visitor {
 public:
  explicit Page(std::string path, Key table = {})
      : path_(std::move(path)), table_(std::move(table)) {}

  std::string text() const {
    std::string all = with_head(rows_);
    for (const Table &table : tables_)
      all += table.heading + (is_elsewhere(table) ? "" : "\n" + with_head(table.rows));
    return all;
  }

  void key(const Key &key, Value value) override {
    const std::string type = std::visit(TypeName{key}, value), standard = default_of(key, value),
                      text = meaning(key, value);
    rows_ += fmt::format(row, key.name, type, key.unit, standard, text);
    if (key.name == table_.sole)
      row_of_value_ = fmt::format(
          row, table_.name, type + " or table", key.unit, table_.required ? "required" : standard,
          fmt::format("`{}` of [{}], or that table{}", key.name, path_, only_with(table_)));
  }

  bool given(const Key &, bool) override { return true; }

  void table(const Key &key, const Body &body) override { add(key, body, "[", "]"); }

  int count(const Key &, int) override { return 1; }

  void entry(const Key &key, int, const Body &body) override {
    add(key, body, key.may_be_table ? "[" : "[[", key.may_be_table ? "]" : "]]");
  }

 private:
  static std::string default_of(const Key &key, Value value) {
    if (key.required)
      return "required";
    if (!key.default_words.empty())
      return key.default_words;
    return key.optional ? "" : "`" + toml_text(value) + "`";
  }

  static std::string meaning(const Key &key, Value value) {
    std::string text = key.description;
    if (!key.choices_words.empty())
      text += "; one of " + key.choices_words;
    else if (!key.choices.empty())
      text += "; one of " + code_list(key.choices);
    if (!key.length.words.empty() && !std::holds_alternative<Matrix *>(value))
      text += "; entries: " + key.length.words;
    if (const std::string range = key.range.words(); !range.empty())
      text += "; " + range;
    if (const std::string sizes = key.range.sense_words(""); !sizes.empty())
      text += "; " + sizes;
    if (key.constant_in_time)
      text += "; must not depend on t";
    return text + only_with(key);
  }

  static std::string only_with(const Key &key) {
    return key.used.words.empty() ? "" : "; only with `" + key.used.words + "`";
  }

  struct Table {
    std::string path, heading, rows;
  };

  static std::string with_head(const std::string &rows) {
    constexpr std::string_view head =
        "| key | type | unit | default | meaning |\n"
        "| --- | --- | --- | --- | --- |\n";
    return rows.empty() ? "" : std::string(head) + rows;
  }

  // Whether a table nearer to the top has the same keys; the description says which.
  bool is_elsewhere(const Table &table) const {
    return std::any_of(tables_.begin(), tables_.end(), [&](const Table &other) {
      return !table.rows.empty() && other.rows == table.rows &&
             other.path.size() < table.path.size();
    });
  }

  void add(const Key &key, const Body &body, const char *open, const char *close) {
    const std::string path = path_.empty() ? key.name : path_ + "." + key.name;
    Page inner(path, key);
    body(inner);
    rows_ += inner.row_of_value_;
    const char *level = path_.empty() ? "##" : "###";
    const std::string required = key.required ? " Required." : "",
                      only = key.used.words.empty() ? "" : " Only with `" + key.used.words + "`.";
    tables_.push_back({path,
                       fmt::format("\n{} {}{}{}\n\n{}.{}{}\n", level, open, path, close,
                                   key.description, required, only),
                       inner.rows_});
    tables_.insert(tables_.end(), inner.tables_.begin(), inner.tables_.end());
  }

  static constexpr const char *row = "| `{}` | {} | {} | {} | {} |\n";

  std::string path_, rows_;
  Key table_;
  std::string row_of_value_;  ///< among the keys around, where a value may stand for the table
  std::vector<Table> tables_;
};

}  // namespace

std::string reference_page() {
  Case defaults;
  Page page("");
  declare(page, defaults);
  return std::string(introduction) + formulas() + units + "\n## Keys outside of tables\n\n" +
         page.text();
}

}  // namespace tourmaline::casefile
