// Checks of a set-up and messages of failures.
#include <algorithm>
#include <cmath>
#include <sstream>

#include "fpz/sph/option_table.hpp"
#include "fpz/sph/simulation.hpp"

namespace fpz::sph {

namespace {

class Messages {
 public:
  void require(bool condition, const std::string& text) {
    if (!condition) list_.push_back(text);
  }
  std::vector<std::string> take() { return std::move(list_); }

 private:
  std::vector<std::string> list_;
};

std::string entry(const std::string& name, double value, const std::string& constraint) {
  std::ostringstream s;
  s << name << " = " << value << ": " << constraint;
  return s.str();
}

std::string number(const std::string& name, double value, const std::string& constraint) {
  return entry(name, value, "must be " + constraint);
}

/// Checks the number that an option holds; words are always valid.
class OptionCheck {
 public:
  explicit OptionCheck(Messages& messages) : messages_(messages) {}

  void operator()(const OptionInfo& info, double x) const {
    messages_.require(info.valid.hold(x), number(std::string(info.name), x, info.valid.text()));
  }
  void operator()(const OptionInfo& info, int x) const { (*this)(info, static_cast<double>(x)); }
  void operator()(const OptionInfo& info, const RveLength& x) const {
    if (x.rule == RveLength::Rule::number) (*this)(info, x.value);
  }
  template <int Dim>
  void operator()(const OptionInfo& info, const Vec<double, Dim>& x) const {
    for (int c = 0; c < Dim; ++c)
      messages_.require(std::isfinite(x[c]), number(std::string(info.name), x[c], "finite"));
  }
  template <Worded E>
  void operator()(const OptionInfo&, E) const {}

 private:
  Messages& messages_;
};

template <int Dim>
void check_arrangement(const RunSetup<Dim>& s, Messages& m) {
  const Arrangement<Dim>& a = s.arrangement;
  m.require(std::isfinite(a.spacing) && a.spacing > 0.0, number("spacing", a.spacing, "positive"));
  m.require(a.size() > 0, "arrangement: has no particles");
  m.require(a.volume.size() == a.size() && a.group.size() == a.size(),
            "arrangement: position, volume and group must have one length");
  m.require(s.velocity.empty() || s.velocity.size() == a.size(),
            "velocity: must be empty or have one entry per particle");
  if (a.volume.size() != a.size() || a.group.size() != a.size()) return;
  const auto groups = static_cast<int>(s.groups.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    const std::string who = "particle " + std::to_string(i) + ": ";
    if (!is_finite(a.position[i])) m.require(false, who + "position is not finite");
    if (!(std::isfinite(a.volume[i]) && a.volume[i] > 0.0))
      m.require(false, who + number("volume", a.volume[i], "positive"));
    if (a.group[i] < -1 || a.group[i] >= groups)
      m.require(false, who + number("group", a.group[i], "-1 or a group's index"));
  }
}

void check_parameters(Parameters p, Setting setting, const std::string& who, Messages& m) {
  p.rve_length = 1e-6;  // the particles carry their own
  for (const Violation& e : validate(p, setting).errors) {
    m.require(false, who + entry(e.field, e.value, e.constraint));
  }
}

template <int Dim>
void check_weak_planes(const RunSetup<Dim>& s, Messages& m) {
  const WeakPlanes<Dim>& planes = s.weak_planes;
  for (std::size_t k = 0; k < planes.parameters.size(); ++k) {
    check_parameters(planes.parameters[k], s.setting, "weak plane " + std::to_string(k) + ": ", m);
  }
  if (planes.of_particle.empty()) return;
  const std::size_t count = s.arrangement.size();
  m.require(s.options.configuration == Configuration::reference, "weak planes: need the configuration reference");
  m.require(planes.of_particle.size() == count && planes.normal.size() == count,
            "weak planes: must have one entry per particle");
  if (planes.of_particle.size() != count || planes.normal.size() != count) return;
  const auto kinds = static_cast<int>(planes.parameters.size());
  for (std::size_t i = 0; i < count; ++i) {
    const int kind = planes.of_particle[i];
    const std::string who = "weak plane of particle " + std::to_string(i) + ": ";
    if (kind < WeakPlanes<Dim>::none || kind >= kinds) m.require(false, who + "is of a kind that is not there");
    if (kind >= 0 && !(is_finite(planes.normal[i]) && planes.normal[i].norm() > 0.0)) {
      m.require(false, who + "its normal is no direction");
    }
  }
}

template <int Dim>
void check_materials(const RunSetup<Dim>& s, Messages& m) {
  for (std::size_t k = 0; k < s.materials.count(); ++k) {
    check_parameters(parameters_of(s, k), s.setting, k == 0 ? "" : "material " + std::to_string(k) + ": ", m);
  }
  const std::vector<double>& strength = s.materials.strength_factor;
  m.require(strength.empty() || strength.size() == s.arrangement.size(),
            "strength_factor: must have one entry per particle");
  m.require(std::all_of(strength.begin(), strength.end(), [](double f) { return std::isfinite(f) && f > 0.0; }),
            "strength_factor: must be positive");
  const std::vector<int>& of_particle = s.materials.of_particle;
  if (of_particle.empty())
    return m.require(s.materials.further.empty(), "materials: no particle has any but the first");
  m.require(of_particle.size() == s.arrangement.size(), "materials: must have one entry per particle");
  const auto known = [&](int k) { return k >= 0 && static_cast<std::size_t>(k) < s.materials.count(); };
  m.require(std::all_of(of_particle.begin(), of_particle.end(), known),
            "materials: a particle has one that is not there");
}

template <int Dim>
void check_cuts(const Arrangement<Dim>& a, Messages& m) {
  for (std::size_t k = 0; k < a.cuts.size(); ++k) {
    const std::string who = "cut " + std::to_string(k) + ": ";
    const auto& corner = a.cuts[k].corner;
    const bool finite = std::all_of(corner.begin(), corner.end(), [](const auto& x) { return is_finite(x); });
    m.require(finite, who + "an end is not finite");
    if (!finite) continue;
    const bool extends = (corner[1] - corner[0]).norm() > 0.0;
    m.require(extends, who + "has no length");
    for (std::size_t i = 0; extends && i < a.size(); ++i) {
      m.require(!lies_on(a.cuts[k], a.position[i]),
                who + "particle " + std::to_string(i) +
                    " lies on it and belongs to neither side; move the particles (a notch: align them to it, or give "
                    "it a width)");
    }
  }
}

template <int Dim>
void check_drives(const Group<Dim>& g, Messages& m) {
  m.require(!g.hinge || is_finite(*g.hinge), "hinge of group " + g.name + ": must be finite");
  for (const std::optional<Drive>& drive : g.drive) {
    if (!drive) continue;
    const std::string table = problem_of(drive->table);
    m.require(table.empty(), "drive of group " + g.name + ": its table " + table);
    const double stiffness = drive->machine_stiffness;
    m.require(std::isfinite(stiffness) && stiffness >= 0.0,
              number("machine_stiffness of group " + g.name, stiffness, "zero or positive"));
    m.require(drive->kind != Drive::Kind::force || stiffness == 0.0,
              number("machine_stiffness of group " + g.name, stiffness, "zero where a force drives it"));
  }
}

template <int Dim>
void check_load(const Load<Dim>& load, const Arrangement<Dim>& a, Messages& m) {
  const std::string who = "load " + load.name + ": ";
  const std::string table = problem_of(load.factor);
  m.require(table.empty(), who + "its factor " + table);
  m.require(load.force.size() == a.size(), who + "must have a force for each particle");
  if (load.force.size() != a.size() || a.group.size() != a.size()) return;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (!is_finite(load.force[i]))
      m.require(false, who + "the force on particle " + std::to_string(i) + " is not finite");
    m.require(a.group[i] < 0 || load.force[i].isZero(0.0),
              who + "acts on particle " + std::to_string(i) + ", which belongs to a group");
  }
}

}  // namespace

template <int Dim>
std::vector<std::string> problems(const RunSetup<Dim>& s) {
  Messages m;
  for_each_option(s.options, OptionCheck(m));
  check_arrangement(s, m);
  check_cuts(s.arrangement, m);
  m.require((Dim == 3) == (s.setting == Setting::three_d), "setting: must be plane strain or plane stress in 2-D");
  for (const Group<Dim>& g : s.groups) {
    check_drives(g, m);
    const Options<Dim>& o = s.options;
    m.require(g.bonded || (o.configuration == Configuration::reference && o.contact_stiffness > 0.0),
              "group " + g.name +
                  ": one that is not bonded needs contact, which the configuration reference has, with a "
                  "contact_stiffness above 0");
  }
  for (const Load<Dim>& load : s.loads) check_load(load, s.arrangement, m);
  m.require(is_finite(s.initial_stress), "initial_stress: must be finite");
  check_materials(s, m);
  check_weak_planes(s, m);
  return m.take();
}

std::string Outcome::message() const {
  std::ostringstream s;
  if (ok()) return "ok";
  s << "particle " << particle << " at " << time << " s: ";
  switch (failure) {
    case Failure::none:
      break;
    case Failure::constitutive:
      s << "the stress update failed (" << to_string(status) << "). ";
      if (status == Status::snap_back) {
        s << "H is too long for this material: a smaller spacing or rve_length is needed.";
      } else if (status == Status::invalid_input) {
        s << "Its strain is not finite: the run has exploded; likely the time step is too long (courant).";
      } else if (status == Status::no_plastic_flow) {
        s << "A dilation angle above zero is needed.";
      } else {
        s << "A shorter time step (courant) or another integrator may help.";
      }
      break;
    case Failure::not_finite:
      s << "its velocity is not finite; likely the time step is too long (courant) or a particle lost its neighbours.";
      break;
    case Failure::too_fast:
      if (loose) {
        s << "it moves at " << speed
          << " m/s, faster than sound: cracks have cut it from the body, and a load or what it met drives it on; "
             "let the run end before the specimen falls apart (a piece under load: stop at the load's fall).";
        break;
      }
      s << "it moves at " << speed
        << " m/s, faster than sound: the run explodes; likely the time step is too long (courant) or the loading too "
           "fast.";
      break;
  }
  return s.str();
}

template std::vector<std::string> problems<2>(const RunSetup<2>&);

}  // namespace fpz::sph
