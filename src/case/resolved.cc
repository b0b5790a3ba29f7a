#include "case/resolved.h"

#include <utility>

#include "case/schema.h"
#include "case/toml_text.h"

namespace tourmaline::casefile {

namespace {

/// Writes one table. The tables inside it follow its own keys, as TOML wants it.
class Writer : public Visitor {
 public:
  explicit Writer(std::string path) : path_(std::move(path)) {}

  std::string text() const { return keys_ + tables_; }

  void key(const Key &key, Value value) override {
    const std::string text = toml_text(value);
    if (key.used.holds && !text.empty())
      keys_ += key.name + " = " + text + "\n";
  }

  bool given(const Key &, bool present) override { return present; }

  void table(const Key &key, const Body &body) override { add(key, body, "[", "]"); }

  int count(const Key &, int present) override { return present; }

  void entry(const Key &key, int, const Body &body) override { add(key, body, "[[", "]]"); }

 private:
  void add(const Key &key, const Body &body, const char *open, const char *close) {
    const std::string path = path_.empty() ? key.name : path_ + "." + key.name;
    Writer inner(path);
    body(inner);
    const std::string text = inner.text();
    if (!text.empty())
      tables_ += "\n" + (open + path) + close + "\n" + text;
  }

  std::string path_, keys_, tables_;
};

}  // namespace

std::string resolved(const Case &asked) {
  Case copy = asked;  // a visitor may change what it visits; this one does not
  Writer writer("");
  declare(writer, copy);
  return writer.text();
}

}  // namespace tourmaline::casefile
