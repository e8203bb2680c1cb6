#include <algorithm>
#include <cmath>
#include <sstream>

#include "display.hpp"
#include "fpz/calibration/report.hpp"
#include "pictures.hpp"
#include "size_effect_section.hpp"

namespace fpz::calibration {
namespace {

using namespace detail;

/// A cell of a table: bars would end it.
std::string cell(std::string text) {
  for (std::size_t at = text.find('|'); at != std::string::npos; at = text.find('|', at + 2)) text.insert(at, 1, '\\');
  return text;
}

std::string code(const std::string& text) { return std::string("`").append(text).append("`"); }

bool contains(const std::vector<int>& list, std::size_t k) {
  return std::find(list.begin(), list.end(), static_cast<int>(k)) != list.end();
}

class MarkdownReport {
 public:
  MarkdownReport(const Calibration& all, bool with_pictures)
      : all_(all), spec_(all.specification), r_(all.result), with_pictures_(with_pictures) {}

  std::string text() {
    head();
    warnings();  // before the numbers that they are about
    parameters();
    undetermined();
    scenes();
    data();
    derived();
    references();
    energies();
    correlation();
    profiles();
    starts();
    return std::move(out_).str();
  }

 private:
  [[nodiscard]] std::string level() const { return digits(100.0 * spec_.options.confidence) + " %"; }

  void picture(const std::string& name, const std::string& caption) {
    if (with_pictures_) out_ << "\n![" << caption << "](" << name << ".png)\n";
  }

  void head() {
    out_ << "# " << spec_.name << "\n\n";
    if (r_.usable()) {
      out_ << "**The fit is usable.** ";
    } else {
      out_ << "**The fit is NOT usable (" << to_string(r_.status) << "); do not use its parameters.** ";
    }
    out_ << "The solver says: " << r_.message << ".\n\n";
    if (!spec_.description.empty()) out_ << spec_.description << "\n\n";
    const auto fitted = [](const DataSet& d) { return d.role == Role::fit; };
    const auto sets = std::count_if(spec_.data.begin(), spec_.data.end(), fitted);
    const std::size_t unknowns = all_.problem.parameters.size();
    out_ << "Fitted: " << unknowns << (unknowns == 1 ? " unknown to " : " unknowns to ") << sets
         << (sets == 1 ? " data set, " : " data sets, ") << to_string(spec_.setting)
         << ". Degrees of freedom: " << digits(std::round(1e6 * r_.degrees_of_freedom) * 1e-6)
         << ". SI units and numbers to full precision are in `report.json`.\n\n";
  }

  void parameters() {
    out_ << "## Parameters\n\n| parameter | value | standard error | " << level()
         << " interval | start | bounds | notes |\n| --- | --- | --- | --- | --- | --- | --- |\n";
    for (std::size_t k = 0; k < all_.problem.parameters.size(); ++k) parameter_row(k);
    const bool correlated = r_.correlated_error.size() == r_.standard_error.size() && r_.standard_error.size() > 0 &&
                            (r_.correlated_error - r_.standard_error).cwiseAbs().maxCoeff() >
                                0.01 * r_.standard_error.cwiseAbs().maxCoeff();
    if (correlated) {
      out_
          << "\nNeighbouring residuals are alike, so the points say less than their number. Standard errors that allow "
             "for this:";
      for (std::size_t k = 0; k < all_.problem.parameters.size(); ++k) {
        const FitParameter& p = all_.problem.parameters[k];
        out_ << (k > 0 ? ", " : " ") << code(p.name) << ' '
             << shown_value(r_.correlated_error[static_cast<Eigen::Index>(k)], p.unit, 2);
      }
      out_ << ".\n";
    }
    out_ << "\n| fixed | value | from |\n| --- | --- | --- |\n";
    for (std::size_t k = 0; k < parameter_info.size(); ++k) fixed_row(k);
    out_ << "| `density` | " << digits(spec_.density) << " kg/m³ | specification |\n\n";
    for (const std::string& conversion : spec_.conversions) out_ << "- " << conversion << "\n";
    if (!spec_.conversions.empty()) out_ << '\n';
  }

  void parameter_row(std::size_t k) {
    const FitParameter& p = all_.problem.parameters[k];
    const auto i = static_cast<Eigen::Index>(k);
    const auto at = [i](const Eigen::VectorXd& v) { return i < v.size() ? v[i] : NAN; };
    const Display d = display(p.unit, std::isnan(at(r_.values)) || at(r_.values) == 0.0 ? p.upper : at(r_.values));
    const std::string unit = pretty_unit(d.unit);
    const auto show = [&](double x, int n) { return digits(x / d.factor, n); };
    std::string notes;
    if (contains(r_.at_lower_bound, k)) notes += "**at its lower bound** ";
    if (contains(r_.at_upper_bound, k)) notes += "**at its upper bound** ";
    if (p.prior)
      notes.append("prior ").append(show(p.prior->mean, 4)).append(" ± ").append(show(p.prior->deviation, 2));
    out_ << "| " << code(p.name) << (unit.empty() ? "" : ", ") << unit << " | **" << show(at(r_.values), 5) << "** | "
         << show(at(r_.standard_error), 2) << " | " << show(at(r_.lower_limit), 4) << " to "
         << show(at(r_.upper_limit), 4) << " | " << show(p.start, 4) << " | " << show(p.lower, 4) << " to "
         << show(p.upper, 4) << " | " << notes << " |\n";
  }

  void fixed_row(std::size_t k) {
    const ParameterSetting& s = spec_.parameters[k];
    if (s.fitted) return;
    const ParameterInfo<double>& p = parameter_info[k];
    out_ << "| " << code(std::string(p.name)) << " | " << shown_value(s.value, p.unit, 5);
    if (s.from_slope) {
      out_ << " ± " << shown_value(s.from_slope->standard_error, p.unit, 2) << " | initial slope of \""
           << cell(*s.slope_of) << "\": " << cell(s.from_slope->words);
    } else {
      out_ << " | " << cell(s.origin);
    }
    out_ << " |\n";
  }

  void undetermined() {
    out_ << "## What the data cannot determine\n\n";
    if (r_.undetermined.empty()) {
      out_ << "Every fitted parameter leaves its mark on the data: no direction in parameter space is open.\n";
    }
    for (const UndeterminedDirection& d : r_.undetermined) out_ << "- " << d.words << "\n";
    out_ << "\nSingular values of the Jacobian (residuals over deviations, relative changes):";
    for (Eigen::Index k = 0; k < r_.singular_values.size(); ++k) {
      out_ << (k > 0 ? ", " : " ") << digits(r_.singular_values[k], 3);
    }
    out_ << ".\n\n";
  }

  void scenes() {
    if (!all_.scenes || all_.scenes->runs == 0) return;
    const SceneFitSummary& s = *all_.scenes;
    out_ << "## Runs of the scenes\n\nThe scenes were run with " << s.runs << " parameter sets in " << s.rounds
         << (s.rounds == 1 ? " round" : " rounds") << "; the last surface goes through " << s.used << " of them.";
    if (s.failed > 0) out_ << " Without a prediction: " << s.failed << '.';
    if (s.noise_runs > 2) {
      out_ << " Runs whose parameters differ by 0.2 % or less scatter by " << digits(100.0 * s.scatter, 2)
           << " % about the surface.";
    }
    out_ << "\n\n| parameter | standard error | of it, from the scatter of the runs |\n| --- | --- | --- |\n";
    for (Eigen::Index k = 0; k < s.error.size(); ++k) {
      const FitParameter& p = all_.problem.parameters[static_cast<std::size_t>(k)];
      out_ << "| " << code(p.name) << " | " << shown_value(r_.standard_error[k], p.unit, 2) << " | "
           << shown_value(s.error[k], p.unit, 2) << " |\n";
    }
    out_ << '\n';
    for (const std::string& w : s.words) out_ << "- " << w << "\n";
    out_ << '\n';
  }

  void data() {
    out_
        << "## Data\n\n| data set | kind | role | points | rms residual over peak | reduced chi² | lag-1 correlation | "
           "error of the peak |\n| --- | --- | --- | --- | --- | --- | --- | --- |\n";
    std::size_t next = 0;
    for (const Comparison& c : all_.comparisons) {
      const DataSet& set = spec_.data[c.data_set];
      const DataSetResult* result = set.role == Role::fit && next < r_.data.size() ? &r_.data[next++] : nullptr;
      out_ << "| " << cell(set.name) << " | " << set.kind << " | " << (set.role == Role::fit ? "fitted" : "predicted")
           << " | " << set.measured.size() << " | ";
      if (c.ok()) {
        out_ << digits(100.0 * c.rms_over_peak, 3) << " % | ";
      } else {
        out_ << "- | ";
      }
      if (result != nullptr) {
        out_ << (set.deviation_known ? digits(result->reduced_chi_squared, 3) : "-") << " | "
             << digits(result->autocorrelation, 2) << " | ";
      } else {
        out_ << "- | - | ";
      }
      out_ << (c.ok() && set.is_curve() ? percent(c.peak_error, 3) : "-") << " |\n";
    }
    out_ << '\n';
    for (const Comparison& c : all_.comparisons) data_set(c);
    if (any_fitted_values()) {
      picture(residuals_picture, "residuals over their standard deviation");
    }
    out_ << '\n';
  }

  [[nodiscard]] bool any_fitted_values() const {
    return std::any_of(r_.data.begin(), r_.data.end(),
                       [](const DataSetResult& d) { return d.standardised.size() > 0; });
  }

  void data_set(const Comparison& c) {
    const DataSet& set = spec_.data[c.data_set];
    out_ << "### " << set.name << "\n\n";
    if (!set.source.empty()) out_ << "Source: " << set.source << ". ";
    if (!set.file.empty()) out_ << "File: `" << set.file << "` (" << set.notation << "). ";
    out_ << "Standard deviation: " << set.deviation_words << ".";
    if (set.weight != 1.0) out_ << " Weight: " << digits(set.weight) << '.';
    out_ << "\n";
    if (!c.ok()) {
      out_ << "\nNo prediction: " << c.failure << "\n\n";
      return;
    }
    if (set.role == Role::predict) {
      out_ << "\nNot fitted but predicted from the parameters above: the largest value is " << percent(c.peak_error, 3)
           << " off the measured one, the rms difference is " << digits(100.0 * c.rms_over_peak, 3)
           << " % of the measured peak.\n";
    }
    if (!set.is_curve()) single_values(set, c);
    picture(data_picture_name(set), "data and fit: " + set.name);
    out_ << '\n';
    if (!c.size_effect) return;
    out_ << size_effect_section(set, *c.size_effect);
    if (c.size_effect->law.ok()) picture(size_effect_picture_name(set), "size effect: " + set.name);
    out_ << '\n';
  }

  void single_values(const DataSet& set, const Comparison& c) {
    const std::string unit = set.value_axis.unit;
    out_ << "\n| value | measured | predicted | difference | in deviations |\n| --- | --- | --- | --- | --- |\n";
    for (Eigen::Index k = 0; k < set.measured.size(); ++k) {
      const auto show = [&](double x) {
        if (!unit.empty()) return digits(x / set.value_axis.factor, 5) + ' ' + pretty_unit(unit);
        const auto row = static_cast<std::size_t>(k);
        return shown_value(x, std::visit([row](const auto& test) { return unit_of_value(test, row); }, set.test), 5);
      };
      out_ << "| " << cell(set.labels[static_cast<std::size_t>(k)]) << " | " << show(set.measured[k]) << " | "
           << show(c.predicted[k]) << " | " << percent(c.predicted[k] / set.measured[k] - 1.0, 3) << " | "
           << digits(c.residuals[k] / c.deviation[k], 2) << " |\n";
    }
  }

  void derived() {
    out_ << "## What follows from the parameters\n\n| quantity | value | standard error |\n| --- | --- | --- |\n";
    for (const Derived& d : all_.derived) {
      const Display unit = display(d.unit, d.value);
      out_ << "| " << d.name << ", " << code(d.symbol) << " | " << shown_value(d.value, d.unit) << " | "
           << (std::isnan(d.standard_error) ? "-" : digits(d.standard_error / unit.factor, 2)) << " |\n";
    }
    out_ << '\n';
  }

  void references() {
    if (all_.references.empty()) return;
    out_ << "## Reference values\n\n";
    for (const ReferenceComparison& c : all_.references) {
      const ParameterInfo<double>* p = nullptr;
      for (const ParameterInfo<double>& q : parameter_info) {
        if (q.name == c.reference.parameter) p = &q;
      }
      out_ << "- " << code(c.reference.parameter) << ": "
           << (c.reference.source.empty() ? "reference" : c.reference.source) << ' '
           << shown_value(c.reference.value, p->unit) << ", fitted " << shown_value(c.fitted, p->unit) << ", "
           << percent(c.relative, 2) << " apart.\n";
    }
    out_ << '\n';
  }

  void energies() {
    if (!all_.energies) return;
    const TwoEnergies& e = *all_.energies;
    out_ << "## Two fracture energies, one delta0\n\n";
    if (!e.ok()) {
      out_ << "No comparison: " << e.failure << "\n\n";
      return;
    }
    out_ << "| | delta0 | energy of the other test |\n| --- | --- | --- |\n| from the mode I energy alone | "
         << shown_value(e.delta0_one, "m") << " | " << shown_value(e.two_at_one, "N/m")
         << " |\n| from the other energy alone | " << shown_value(e.delta0_two, "m") << " | "
         << shown_value(e.one_at_two, "N/m") << " |\n\n";
    for (const std::string& statement : e.statements) out_ << "- " << statement << "\n";
    out_ << '\n';
  }

  void correlation() {
    const Eigen::MatrixXd& c = r_.correlation;
    if (c.rows() < 2) return;
    out_ << "## Correlation\n\n|";
    for (Eigen::Index k = 0; k < c.cols(); ++k) {
      out_ << " | " << code(all_.problem.parameters[static_cast<std::size_t>(k)].name);
    }
    out_ << " |\n| ---";
    for (Eigen::Index k = 0; k < c.cols(); ++k) out_ << " | ---";
    out_ << " |\n";
    for (Eigen::Index i = 0; i < c.rows(); ++i) {
      out_ << "| " << code(all_.problem.parameters[static_cast<std::size_t>(i)].name);
      for (Eigen::Index k = 0; k < c.cols(); ++k) out_ << " | " << digits(c(i, k), 3);
      out_ << " |\n";
    }
    picture(correlation_picture, "correlation of the fitted parameters");
    out_ << '\n';
  }

  void profiles() {
    if (r_.profiles.empty()) return;
    out_
        << "## Profile likelihood\n\nThe other parameters are fitted anew at every value; unlike the interval from the "
           "standard error this one need not be symmetric.\n\n";
    for (const Profile& p : r_.profiles) {
      const FitParameter& q = all_.problem.parameters[static_cast<std::size_t>(p.parameter)];
      const auto end = [&](const std::optional<double>& x) {
        return x ? shown_value(*x, q.unit) : std::string("open within the bounds");
      };
      out_ << "- " << code(q.name) << ", " << level() << ": from " << end(p.lower) << " to " << end(p.upper) << ".\n";
    }
    for (const Profile& p : r_.profiles) {
      const std::string& name = all_.problem.parameters[static_cast<std::size_t>(p.parameter)].name;
      picture(profile_picture_name(name), "profile likelihood of " + name);
    }
    out_ << '\n';
  }

  void starts() {
    if (r_.starts.empty()) return;
    out_ << "## Starts\n\n"
         << r_.starts.size() << " starts, " << r_.distinct_minima
         << (r_.distinct_minima == 1 ? " minimum" : " distinct minima") << ".\n\n| start | cost | iterations | end |\n"
         << "| --- | --- | --- | --- |\n";
    for (std::size_t k = 0; k < r_.starts.size(); ++k) {
      const StartResult& s = r_.starts[k];
      out_ << "| " << k + 1 << " | " << (std::isfinite(s.cost) ? digits(s.cost, 6) : "no prediction") << " | "
           << s.iterations << (s.converged ? "" : " (not converged)") << " | ";
      for (Eigen::Index i = 0; i < s.end.size(); ++i) {
        const FitParameter& p = all_.problem.parameters[static_cast<std::size_t>(i)];
        out_ << (i > 0 ? ", " : "") << code(p.name) << ' ' << shown_value(s.end[i], p.unit);
      }
      out_ << " |\n";
    }
    out_ << '\n';
  }

  void warnings() {
    if (all_.warnings.empty()) return;
    out_ << "## Warnings\n\n";
    for (const std::string& w : all_.warnings) out_ << "- " << w << "\n";
    out_ << '\n';
  }

  const Calibration& all_;
  const Specification& spec_;
  const FitResult& r_;
  bool with_pictures_;
  std::ostringstream out_;
};

}  // namespace

std::string report_markdown(const Calibration& all, bool with_pictures) {
  return MarkdownReport(all, with_pictures).text();
}

std::string short_table(const Calibration& all) {
  std::ostringstream out;
  const FitResult& r = all.result;
  out << all.specification.name << ": " << to_string(r.status) << ". " << r.message << "\n";
  for (std::size_t k = 0; k < all.problem.parameters.size(); ++k) {
    const FitParameter& p = all.problem.parameters[k];
    const auto i = static_cast<Eigen::Index>(k);
    if (i >= r.values.size()) break;
    const Display d = display(p.unit, r.values[i]);
    std::string name = p.name;
    name.resize(std::max<std::size_t>(name.size() + 1, 24), ' ');
    out << "  " << name << digits(r.values[i] / d.factor, 6);
    if (i < r.correlated_error.size()) out << " +- " << digits(r.correlated_error[i] / d.factor, 2);
    out << ' ' << d.unit;
    if (contains(r.at_lower_bound, k)) out << "  (at its lower bound)";
    if (contains(r.at_upper_bound, k)) out << "  (at its upper bound)";
    out << "\n";
  }
  if (r.correlated_error.size() > 0) out << "  (+- standard errors, correlated residuals allowed for)\n";
  for (const Comparison& c : all.comparisons) {
    const DataSet& set = all.specification.data[c.data_set];
    if (set.role != Role::predict || !c.ok()) continue;
    out << "  predicted " << set.name << ": peak " << percent(c.peak_error, 3) << ", rms "
        << digits(100.0 * c.rms_over_peak, 3) << " % of the measured peak\n";
  }
  return std::move(out).str();
}

}  // namespace fpz::calibration
