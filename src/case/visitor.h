#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "tourmaline/case/formula.h"
#include "tourmaline/case/range.h"

/// What may be said of a key of the case file, and the visitors that it is said to.
namespace tourmaline::casefile {

struct MeshCase;

/// The numbers of entries that a list may have.
struct Length {
  std::vector<int> counts;  ///< empty: any
  std::string words;        ///< what the entries stand for
  std::string reason = {};  ///< why it is that many
};

Length one_each_axis(int dimension);

/// Whether the rest of its table gives a key a meaning, and what the rest must say for that.
struct Use {
  bool holds = true;
  std::string words = {};
};

/// Used where the key `name`, whose value is `actual`, has one of these values.
Use with(const std::string &name, const std::string &actual,
         const std::vector<std::string> &values);
/// Used where that key or table is given.
Use with(const std::string &name, bool is_given);

struct Key {
  std::string name;
  std::string description;  ///< a phrase without capital and full stop; of a table a sentence
  std::string unit = {};    ///< of its numbers, as documents say it
  bool required = false;
  Range range = {};                       ///< of a number, and of a formula that is one
  std::vector<std::string> choices = {};  ///< the texts that are allowed; empty: any
  std::string choices_words = {};         ///< all of them, where they depend on the dimension
  Length length = {};                     ///< of a list, and of each row of a matrix
  int rows = 0;                           ///< of a matrix
  bool constant_in_time = false;          ///< of a formula
  std::string default_words = {};         ///< the default where the value does not say it
  Use used = {};
  bool optional = false;               ///< not giving it differs from giving any value
  std::string no_choices = {};         ///< why no text is allowed where `choices` is empty
  std::vector<std::string> also = {};  ///< symbols and names by which others know it
  /// Names that others have for choices, and the choice.
  std::vector<std::pair<std::string, std::string>> choices_also = {};
  /// Of a table: the key that a value stands for which is given instead of the table. With "law",
  /// `normal = "unilateral"` is `normal = { law = "unilateral" }`.
  std::string sole = {};
  /// Of an array of tables: a single entry may stand as a table, [contact], with no number in its
  /// path.
  bool may_be_table = false;
  /// The unit in the case at hand, where that decides and `unit` has the words for it. It is also
  /// what a number with a unit of its own is converted to.
  std::string unit_here = {};
  bool is_absolute_temperature = false;  ///< others are differences, which degC is no unit of

  const std::string &actual_unit() const { return unit_here.empty() ? unit : unit_here; }
};

/// One entry for each component; empty where the component is free.
using Displacement = std::vector<std::optional<Formula>>;
using Matrix = std::vector<std::vector<double>>;
/// What a key's value is read into. A list of texts may also be given as one text.
using Value = std::variant<bool *, int *, double *, std::string *, std::vector<std::string> *,
                           std::vector<int> *, std::vector<double> *, Matrix *, Formula *,
                           FormulaVector *, Displacement *>;

class Visitor {
 public:
  using Body = std::function<void(Visitor &)>;
  using Complaint = std::function<std::string()>;

  virtual ~Visitor() = default;

  virtual void key(const Key &key, Value value) = 0;
  /// Whether an optional key or table is to be visited; `present` says whether the case holds it.
  virtual bool given(const Key &key, bool present) = 0;
  /// A table inside this one; `body` declares its keys, and may be called more than once. Where
  /// the table is not used, its keys need not be visited.
  virtual void table(const Key &key, const Body &body) = 0;
  /// An array of tables: how many entries there are to visit, where the case holds `present`.
  virtual int count(const Key &key, int present) = 0;
  virtual void entry(const Key &key, int index, const Body &body) = 0;

  /// A name that one may expect here, and why there is no such key.
  virtual void refuse(const std::string & /*name*/, const std::string & /*reason*/) {}
  /// A condition on several keys: `complaint` returns what is wrong with `name` (empty: the table),
  /// or nothing. Only called once all keys declared before have been read.
  virtual void check(const std::string & /*name*/, const Complaint & /*complaint*/) {}
  /// Of these keys and tables a case gives exactly one; a `check` complains otherwise.
  virtual void exactly_one(const std::vector<std::string> & /*names*/) {}
  /// Of these groups of keys a table gives one, all of it and nothing of the others; a `check`
  /// complains otherwise.
  virtual void one_group(const std::vector<std::vector<std::string>> & /*groups*/) {}
  /// The mesh that a file holds, so that what follows can be checked against its names.
  virtual void load(MeshCase & /*mesh*/) {}
  /// A file's name, to be found from the folder of the case.
  virtual void locate(const std::string & /*name*/, std::string & /*file*/) {}
  /// Where this table stands, for later error texts.
  virtual void place(std::string & /*where*/) {}
  /// Where each of the keys stands that this table gives, by name.
  virtual void places(std::map<std::string, std::string> & /*where*/) {}

  template <class T>
  void optional(Key key_, std::optional<T> &value) {
    key_.optional = true;
    if (!given(key_, value.has_value()))
      return;
    if (!value)
      value.emplace();
    key(key_, &*value);
  }

  /// A table that a case may do without; `declare` is called with a visitor and its value.
  template <class T, class Declare>
  void optional_table(Key key_, std::optional<T> &value, const Declare &declare) {
    key_.optional = true;
    if (!given(key_, value.has_value()))
      return;
    if (!value)
      value.emplace();
    table(key_, [&](Visitor &inner) { declare(inner, *value); });
  }

  /// An array of tables, `declare` as above for each.
  template <class T, class Declare>
  void entries(const Key &key_, std::vector<T> &values, const Declare &declare) {
    values.resize(static_cast<std::size_t>(count(key_, static_cast<int>(values.size()))));
    for (std::size_t i = 0; i < values.size(); ++i)
      entry(key_, static_cast<int>(i), [&](Visitor &inner) { declare(inner, values[i]); });
  }
};

}  // namespace tourmaline::casefile
