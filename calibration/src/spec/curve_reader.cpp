#include "curve_reader.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "fpz/io/csv_options.hpp"

namespace fpz::calibration::detail {
namespace {

using Kind = JsonValue::Kind;
using io::in_quotes;

constexpr std::size_t longest_text = 4000;
constexpr int most_points = 100'000;
constexpr double default_relative_deviation = 0.01;
constexpr double default_edges_at = 2.0;
constexpr std::array<std::string_view, 2> list_keys = {"list", "unit"};
constexpr std::array<std::string_view, 3> plain_column_keys = {"column", "unit", "scale"};
constexpr std::array<std::string_view, 5> band_column_keys = {"low", "high", "unit", "scale", "edges_at"};
constexpr std::array<std::string_view, 6> deviation_keys = {"value",  "relative", "relative_to_peak",
                                                            "column", "unit",     "known"};
constexpr std::array<std::string_view, 3> range_keys = {"from", "to", "unit"};

std::string count_of(std::size_t n, const char* what) { return std::to_string(n) + ' ' + what + (n == 1 ? "" : "s"); }

/// Columns before anything is checked between them.
struct RawColumn {
  Eigen::VectorXd values;
  Eigen::VectorXd half_width;  ///< of a band, in deviations' multiples `edges_at`; empty without one
  double edges_at = default_edges_at;
};

class CurveReader {
 public:
  CurveReader(const Context& c, const std::filesystem::path& folder, const Place& set, const CurveNeeds& needs)
      : c_(c), folder_(folder), set_(set), needs_(needs) {}

  std::optional<Curve> read() {
    const std::size_t before = c_.reader.problems().size();
    const auto good = [&] { return c_.reader.problems().size() == before; };
    std::vector<RawColumn> raw = from_file_or_lists();
    if (!good() || raw.empty()) return std::nullopt;
    check_order(raw);
    Curve curve;
    curve.file = file_name_;
    if (table_) curve.notation = table_->notation;
    if (!good() || !add_deviation(raw[needs_.measured], curve)) return std::nullopt;
    for (RawColumn& column : raw) curve.columns.push_back(std::move(column.values));
    select(curve);
    if (!good()) return std::nullopt;
    return curve;
  }

 private:
  [[nodiscard]] const JsonValue* member(std::string_view key) const { return set_.value().find(key); }

  std::vector<RawColumn> from_file_or_lists() {
    const JsonValue* file = member("file");
    const JsonValue* values = member("values");
    if ((file == nullptr) == (values == nullptr)) {
      c_.problem(set_, "give either \"file\" with \"columns\" or \"values\"");
      return {};
    }
    if (file == nullptr) {
      bool wrong = false;
      for (const std::string_view key : file_keys()) {
        const JsonValue* v = member(key);
        if (v != nullptr) c_.problem(Place(set_, *v), in_quotes(key) + " goes with \"file\"");
        wrong = wrong || v != nullptr;
      }
      return wrong ? std::vector<RawColumn>{} : from_lists(Place(set_, *values));
    }
    return from_file(Place(set_, *file));
  }

  [[nodiscard]] static std::vector<std::string_view> file_keys() {
    std::vector<std::string_view> keys(io::csv_option_keys.begin(), io::csv_option_keys.end());
    keys.emplace_back("columns");
    return keys;
  }

  /// A row in warnings.
  [[nodiscard]] std::string place_of(std::size_t row, const std::string& column) const {
    if (table_)
      return table_->origin + ':' + std::to_string(table_->lines[row]) + ": column " + in_quotes(column) + ' ';
    return "values." + column + '[' + std::to_string(row) + "] ";
  }

  /// A row in messages: its line in the CSV file, or its place in the list.
  void row_problem(std::size_t row, const std::string& column, const std::string& text) {
    if (table_) {
      c_.reader.problems().add(table_->origin, table_->lines[row], "column " + in_quotes(column) + ": " + text);
    } else {
      c_.problem(set_, "values." + column + '[' + std::to_string(row) + "]: " + text);
    }
  }

  std::vector<RawColumn> from_lists(const Place& values) {
    if (!c_.reader.object(values, "a list per quantity")) return {};
    std::vector<std::string_view> names;
    for (const Wanted& w : needs_.wanted) names.push_back(w.name);
    c_.reader.known_keys(values, names);
    std::vector<RawColumn> raw;
    for (const Wanted& w : needs_.wanted) {
      const JsonValue* list = c_.reader.required(values, w.name);
      if (list == nullptr) continue;
      raw.push_back({read_list(Place(values, *list), w.quantity), {}, default_edges_at});
      names_.emplace_back(w.name);
    }
    if (raw.size() != needs_.wanted.size()) return {};
    for (std::size_t k = 1; k < raw.size(); ++k) {
      if (raw[k].values.size() == raw[0].values.size()) continue;
      c_.problem(values, '"' + names_[k] + "\" has " +
                             count_of(static_cast<std::size_t>(raw[k].values.size()), "value") + ", \"" + names_[0] +
                             "\" has " + std::to_string(raw[0].values.size()));
    }
    return raw;
  }

  Eigen::VectorXd read_list(const Place& at, Quantity quantity) {
    Unit unit = units(quantity).front();
    const JsonValue* list = &at.value();
    if (list->is(Kind::object)) {
      c_.reader.known_keys(at, list_keys);
      unit = read_unit(c_, at, quantity).value_or(unit);
      list = c_.reader.required(at, "list");
      if (list == nullptr) return {};
    }
    const Place place = list == &at.value() ? at : Place(at, *list);
    if (!c_.reader.array(place, "numbers")) return {};
    Eigen::VectorXd x(static_cast<Eigen::Index>(list->items.size()));
    for (std::size_t k = 0; k < list->items.size(); ++k) {
      x[static_cast<Eigen::Index>(k)] = c_.reader.number(Place(place, list->items[k])).value_or(0.0) * unit.factor;
    }
    return x;
  }

  std::vector<RawColumn> from_file(const Place& file) {
    const auto name = c_.reader.text(file, longest_text);
    if (!name) return {};
    if (name->find('\0') != std::string::npos) {
      c_.problem(file, "a file name with a zero character");
      return {};
    }
    file_name_ = *name;
    const std::filesystem::path path = folder_ / *name;
    const std::string shown = path.lexically_normal().string();
    std::string text, error;
    if (!io::load_text(path, io::FileKind::regular, c_.reader.limits(), text, error)) {
      c_.problem(file, "cannot read data file " + in_quotes(shown) + ": " + error);
      return {};
    }
    try {
      table_ = io::parse_csv(text, shown, io::read_csv_options(c_.reader, set_));
    } catch (const io::InputError& e) {
      c_.problem(file, e.what());
      return {};
    }
    c_.warnings.insert(c_.warnings.end(), table_->remarks.begin(), table_->remarks.end());
    const JsonValue* columns = c_.reader.required(set_, "columns");
    if (columns == nullptr) return {};
    const Place at(set_, *columns);
    if (!c_.reader.object(at, "a column per quantity")) return {};
    std::vector<std::string_view> known;
    for (const Wanted& w : needs_.wanted) known.push_back(w.name);
    c_.reader.known_keys(at, known);
    std::vector<RawColumn> raw;
    for (std::size_t k = 0; k < needs_.wanted.size(); ++k) {
      const JsonValue* entry = c_.reader.required(at, needs_.wanted[k].name);
      if (entry == nullptr) continue;
      names_.emplace_back(needs_.wanted[k].name);
      raw.push_back(read_entry(Place(at, *entry), needs_.wanted[k].quantity, k == needs_.measured));
    }
    return raw.size() == needs_.wanted.size() ? raw : std::vector<RawColumn>{};
  }

  /// A column's name or number, {"column", "unit", "scale"}, or for the measured quantity a band {"low", "high",
  /// "unit", "scale", "edges_at"}.
  RawColumn read_entry(const Place& at, Quantity quantity, bool measured) {
    RawColumn raw;
    const JsonValue& v = at.value();
    if (!v.is(Kind::object)) {
      raw.values = column(at, at, quantity);
      return raw;
    }
    if (!c_.reader.object(at, "\"column\" and \"unit\"")) return raw;
    const bool band = measured && (v.find("low") != nullptr || v.find("high") != nullptr);
    c_.reader.known_keys(at, band ? std::span<const std::string_view>(band_column_keys) : plain_column_keys);
    const auto named = [&](std::string_view key) -> Eigen::VectorXd {
      const JsonValue* name = c_.reader.required(at, key);
      return name != nullptr ? column(Place(at, *name), at, quantity) : Eigen::VectorXd();
    };
    if (!band) {
      raw.values = named("column");
      return raw;
    }
    const Eigen::VectorXd low = named("low");
    const Eigen::VectorXd high = named("high");
    if (const JsonValue* edges = v.find("edges_at")) {
      raw.edges_at = c_.reader.positive(Place(at, *edges)).value_or(default_edges_at);
    }
    if (low.size() != high.size() || low.size() == 0) return raw;
    for (Eigen::Index k = 0; k < low.size(); ++k) {
      if (low[k] < high[k]) continue;
      row_problem(static_cast<std::size_t>(k), names_.back(), "the upper edge of the band must be above the lower one");
      return raw;
    }
    raw.values = 0.5 * (low + high);
    raw.half_width = 0.5 * (high - low);
    return raw;
  }

  /// The place in the table of the column whose name or number stands at `at`.
  std::optional<std::size_t> index_of(const Place& at) {
    const std::size_t count = table_->columns.size();
    if (at.value().is(Kind::number)) {
      const auto number = c_.reader.integer(at, 1, static_cast<int>(count));
      if (!number) return std::nullopt;
      return static_cast<std::size_t>(*number) - 1;
    }
    const auto name = c_.reader.text(at, longest_text);
    if (!name) return std::nullopt;
    try {
      const std::optional<std::size_t> index = table_->index(*name);
      if (!index) c_.problem(at, table_->no_column(*name));
      return index;
    } catch (const io::InputError& e) {
      c_.problem(at, e.what());
      return std::nullopt;
    }
  }

  /// What turns the numbers of a column into SI: its unit, from `entry` or else from the file, times "scale".
  std::optional<double> factor_of(std::size_t column, const Place& entry, Quantity quantity) {
    const JsonValue& v = entry.value();
    const bool stated = v.is(Kind::object) && v.find("unit") != nullptr;
    std::optional<Unit> unit = read_unit(c_, entry, quantity);
    const std::string& own = table_->units[column];
    const std::optional<Unit> in_file = io::find_unit(quantity, own);
    const std::string who = table_->origin + ": column " + name_of(column);
    if (stated && unit && !own.empty() && (!in_file || in_file->factor != unit->factor)) {
      c_.warn(entry, who + " is in " + own + " according to the file; it is taken to be in " + std::string(unit->name) +
                         " as stated here");
    }
    if (!stated && !own.empty()) {
      if (!in_file) {
        std::vector<std::string_view> names;
        for (const Unit& u : units(quantity)) names.push_back(u.name);
        c_.problem(entry, who + " is in " + in_quotes(own) + ", which is not known for this quantity" +
                              io::suggestion(own, names));
        return std::nullopt;
      }
      unit = in_file;
    }
    if (!unit) return std::nullopt;
    const JsonValue* scale = v.is(Kind::object) ? v.find("scale") : nullptr;
    if (scale == nullptr) return unit->factor;
    const auto x = c_.reader.number(Place(entry, *scale));
    if (x && *x == 0.0) c_.problem(Place(entry, *scale), "must not be zero; -1 turns the sign");
    if (!x || *x == 0.0) return std::nullopt;
    return *x * unit->factor;
  }

  [[nodiscard]] std::string name_of(std::size_t column) const {
    const std::string& name = table_->names[column];
    return name.empty() ? std::to_string(column + 1) : in_quotes(name);
  }

  Eigen::VectorXd column(const Place& at, const Place& entry, Quantity quantity) {
    const std::optional<std::size_t> index = index_of(at);
    const std::optional<double> factor = index ? factor_of(*index, entry, quantity) : std::nullopt;
    if (!factor) return {};
    const std::vector<double>& cells = table_->columns[*index];
    Eigen::VectorXd x(static_cast<Eigen::Index>(cells.size()));
    for (std::size_t k = 0; k < cells.size(); ++k) {
      x[static_cast<Eigen::Index>(k)] = cells[k] * *factor;
      if (std::isfinite(cells[k])) continue;
      row_problem(k, table_->names[*index], "the cell is not a finite number");
      return {};
    }
    return x;
  }

  void check_order(const std::vector<RawColumn>& raw) {
    const Eigen::Index n = raw.front().values.size();
    if (n < needs_.least_points) {
      c_.problem(set_, "has " + count_of(static_cast<std::size_t>(n), "point") + "; a curve needs at least " +
                           std::to_string(needs_.least_points));
      return;
    }
    if (!needs_.abscissa) return;
    const Eigen::VectorXd& x = raw[*needs_.abscissa].values;
    const std::string name(needs_.wanted[*needs_.abscissa].name);
    for (Eigen::Index k = 1; k < n && !is_cyclic(); ++k) {
      const auto row = static_cast<std::size_t>(k);
      if (x[k] == x[k - 1]) c_.warn(set_, place_of(row, name) + "has the value of the row before");
      if (x[k] >= x[k - 1]) continue;
      row_problem(row, name,
                  "is below the value of the row before; the rows must be sorted by " + name +
                      " (for unloading cycles, in the order of time, say \"cyclic\": true; where it falls all along, "
                      "give the column \"scale\": -1)");
      return;
    }
  }

  bool is_cyclic() {
    const JsonValue* cyclic = member("cyclic");
    return cyclic != nullptr && read_boolean(c_, Place(set_, *cyclic)).value_or(false);
  }

  bool add_deviation(const RawColumn& measured, Curve& curve) {
    const JsonValue* given = member("deviation");
    if (given == nullptr && measured.half_width.size() > 0) {
      curve.deviation = measured.half_width / measured.edges_at;
      curve.deviation_words = "half the width of the measured band over " + io::exact(measured.edges_at);
      return true;
    }
    std::optional<Deviation> d;
    if (given != nullptr && given->is(Kind::object) && given->find("column") != nullptr) {
      d = deviation_column(Place(set_, *given));
    } else {
      d = read_deviation(c_, set_, needs_.wanted[needs_.measured].quantity, measured.values);
    }
    if (!d) return false;
    curve.deviation = std::move(d->values);
    curve.deviation_known = d->known;
    curve.deviation_words = std::move(d->words);
    return true;
  }

  std::optional<Deviation> deviation_column(const Place& at) {
    c_.reader.known_keys(at, deviation_keys);
    if (!table_) {
      c_.problem(at, "\"column\" goes with \"file\"");
      return std::nullopt;
    }
    const Place name(at, *at.value().find("column"));
    Deviation d;
    d.values = column(name, at, needs_.wanted[needs_.measured].quantity);
    d.words = "column " + in_quotes(name.value().text);
    if (const JsonValue* known = at.value().find("known")) d.known = read_boolean(c_, Place(at, *known)).value_or(true);
    for (Eigen::Index k = 0; k < d.values.size(); ++k) {
      if (d.values[k] > 0.0) continue;
      row_problem(static_cast<std::size_t>(k), name.value().text, "a standard deviation must be > 0");
      return std::nullopt;
    }
    if (d.values.size() == 0) return std::nullopt;
    return d;
  }

  /// Applies "range" and "thin".
  void select(Curve& curve) {
    std::vector<Eigen::Index>& rows = curve.used;
    for (Eigen::Index k = 0; k < curve.columns.front().size(); ++k) rows.push_back(k);
    const std::size_t all = rows.size();
    const JsonValue* range = member("range");
    const JsonValue* thin = member("thin");
    if ((range != nullptr || thin != nullptr) && is_cyclic()) {
      c_.problem(Place(set_, range != nullptr ? *range : *thin), "cannot be applied to cycles, which need every row");
      return;
    }
    if (range != nullptr) keep_range(Place(set_, *range), curve, rows);
    if (rows.size() < static_cast<std::size_t>(needs_.least_points)) {
      if (rows.size() != all) {
        c_.problem(Place(set_, *range), "leaves " + count_of(rows.size(), "point") + " of " + std::to_string(all));
      }
      return;
    }
    if (thin == nullptr) return;
    const auto most = c_.reader.integer(Place(set_, *thin), static_cast<int>(needs_.least_points), most_points);
    if (most && rows.size() > static_cast<std::size_t>(*most)) rows = spread(rows, static_cast<std::size_t>(*most));
  }

  void keep_range(const Place& at, const Curve& curve, std::vector<Eigen::Index>& rows) {
    if (!needs_.abscissa) {
      c_.problem(at, "these values have no order of which a range could be taken");
      return;
    }
    if (!c_.reader.object(at, "\"from\" and \"to\"")) return;
    c_.reader.known_keys(at, range_keys);
    const auto unit = read_unit(c_, at, needs_.wanted[*needs_.abscissa].quantity);
    const auto limit = [&](std::string_view key, double otherwise) {
      const JsonValue* v = at.value().find(key);
      return v != nullptr && unit ? c_.reader.number(Place(at, *v)).value_or(0.0) * unit->factor : otherwise;
    };
    const double from = limit("from", -INFINITY);
    const double to = limit("to", INFINITY);
    const Eigen::VectorXd& x = curve.columns[*needs_.abscissa];
    std::erase_if(rows, [&](Eigen::Index k) { return x[k] < from || x[k] > to; });
  }

  /// `n` of the rows, evenly, first and last included.
  static std::vector<Eigen::Index> spread(const std::vector<Eigen::Index>& rows, std::size_t n) {
    std::vector<Eigen::Index> some;
    for (std::size_t k = 0; k < n; ++k) some.push_back(rows[k * (rows.size() - 1) / (n - 1)]);
    return some;
  }

  const Context& c_;
  const std::filesystem::path& folder_;
  const Place& set_;
  const CurveNeeds& needs_;
  std::string file_name_;
  std::vector<std::string> names_;
  std::optional<io::Table> table_;
};

}  // namespace

std::optional<Curve> read_curve(const Context& c, const std::filesystem::path& folder, const Place& set,
                                const CurveNeeds& needs) {
  return CurveReader(c, folder, set, needs).read();
}

std::optional<std::size_t> which_column(const Context& c, const Place& set, std::span<const Wanted> candidates) {
  std::vector<std::string_view> names;
  for (const Wanted& w : candidates) names.push_back(w.name);
  for (const std::string_view key : {"columns", "values"}) {
    const JsonValue* object = set.value().find(key);
    if (object == nullptr || !object->is(Kind::object)) continue;
    for (std::size_t k = 0; k < candidates.size(); ++k) {
      if (object->find(candidates[k].name) != nullptr) return k;
    }
    std::string text = "has none of the quantities ";
    for (std::size_t k = 0; k < names.size(); ++k) text += (k > 0 ? ", " : "") + std::string(names[k]);
    c.problem(Place(set, *object), text);
    return std::nullopt;
  }
  c.problem(set, "give either \"file\" with \"columns\" or \"values\"");
  return std::nullopt;
}

std::optional<Deviation> read_deviation(const Context& c, const Place& set, Quantity quantity,
                                        const Eigen::VectorXd& measured) {
  Deviation d;
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(measured.size());
  const double peak = measured.cwiseAbs().maxCoeff();
  const JsonValue* given = set.value().find("deviation");
  if (given == nullptr) {
    if (measured.size() < 2) {
      c.problem(set, "missing key \"deviation\": from a single value no scatter can be estimated");
      return std::nullopt;
    }
    if (peak <= 0.0) {
      c.problem(set, "all measured values are zero");
      return std::nullopt;
    }
    d.values = default_relative_deviation * peak * ones;
    d.known = false;
    d.words = "equal for all points, estimated from the residuals";
    return d;
  }
  const Place at(set, *given);
  const auto positive = [&](const Place& place) { return c.reader.positive(place); };
  if (!given->is(Kind::object)) {
    const auto x = positive(at);
    if (!x) return std::nullopt;
    d.values = *x * ones;
    d.words = io::exact(*x) + ' ' + std::string(si_unit(quantity));
    return d;
  }
  if (!c.reader.object(at, "\"value\", \"relative\" or \"relative_to_peak\"")) return std::nullopt;
  const std::size_t before = c.reader.problems().size();
  c.reader.known_keys(at, deviation_keys);
  const auto unit = read_unit(c, at, quantity);
  const JsonValue* value = given->find("value");
  const JsonValue* relative = given->find("relative");
  const JsonValue* to_peak = given->find("relative_to_peak");
  if ((value != nullptr) + (relative != nullptr) + (to_peak != nullptr) != 1) {
    c.problem(at, "give one of \"value\", \"relative\", \"relative_to_peak\", \"column\"");
    return std::nullopt;
  }
  if (const JsonValue* known = given->find("known")) d.known = read_boolean(c, Place(at, *known)).value_or(true);
  if (value != nullptr) {
    const auto x = positive(Place(at, *value));
    if (x && unit) d.values = *x * unit->factor * ones;
    if (x && unit) d.words = io::exact(*x) + ' ' + std::string(unit->name);
  } else if (relative != nullptr) {
    const auto x = c.reader.number_between(Place(at, *relative), 0.0, 10.0);
    if (x) d.values = *x * measured.cwiseAbs();
    if (x) d.words = io::exact(*x * 100.0) + " % of each value";
    for (Eigen::Index k = 0; k < d.values.size(); ++k) {
      if (d.values[k] > 0.0) continue;
      c.problem(at, "measured value number " + std::to_string(k + 1) +
                        " is zero, and so would be its deviation; use \"relative_to_peak\" or \"value\"");
      break;
    }
  } else {
    const auto x = c.reader.number_between(Place(at, *to_peak), 0.0, 10.0);
    if (x && peak <= 0.0) c.problem(at, "all measured values are zero");
    if (x) d.values = *x * peak * ones;
    if (x) d.words = io::exact(*x * 100.0) + " % of the largest value";
  }
  if (c.reader.problems().size() != before) return std::nullopt;
  if (!d.known) d.words += ", their common factor estimated from the residuals";
  return d;
}

}  // namespace fpz::calibration::detail
