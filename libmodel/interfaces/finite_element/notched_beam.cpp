// A finite-element program around the library, in one file: a notched beam under three-point bending, constant-strain
// triangles with a fracture process zone embedded in each, quasi-static, the opening of the notch prescribed.
//
//   fpz-fe-beam SIZE OUT.csv [INTEGRATOR [own_planes]]
//
// SIZE is that of the elements, m; it must divide the length of the notch. What to look at: element_length(), the H of
// an element from its plane; Beam::place_zones(), which plane; Beam::assemble(), where the library is called;
// Beam::step(), Newton's method with the consistent tangent. Lengths in m, forces in N. Needs the installed package and
// Eigen, nothing else. Exit status: 0 done; 1 Newton's method did not come through; 2 bad usage, or a file that cannot
// be written.
#include <Eigen/SparseLU>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "fpz/onset.hpp"
#include "fpz/tangent.hpp"

namespace {

using Vector = Eigen::VectorXd;
using Strain = fpz::Tensor<double, 2>;  // xx, yy, xy: the shear is the tensor component

/// The beam of section 5.1 of the paper. Load and supports are even pressures over `roller`.
constexpr double half_length = 0.16, depth = 0.08, half_span = 0.12, notch = 0.008, thickness = 0.04, roller = 0.008;

/// Table 2 of the paper with the cohesion raised, so that it cracks in mode I. H is that of each element.
fpz::Parameters concrete() {
  fpz::Parameters p;
  p.young_modulus = 45e9;
  p.poisson_ratio = 0.24;
  p.density = 2400.0;
  p.tensile_strength = 2.9e6;
  p.cohesion = 5e6;
  p.friction_angle_deg = 37.0;
  p.dilation_angle_deg = 5.0;
  p.delta0 = 16.4e-6;
  p.normal_stiffness = 1e14;
  p.shear_stiffness = 1e11;
  return p;
}

struct Triangle {
  std::array<int, 3> node{};
  std::array<Eigen::Vector2d, 3> gradient;  ///< of the shape functions, 1/m
  double area = 0.0;
  fpz::Material<double> material;  ///< with the H of this element
  fpz::State2 begin, end;          ///< at the begin of the step, and now
};

/// H of a triangle that cracks on a plane: its height along the normal, 1/max |grad N . n|. The plane has one node
/// alone on its side; a jump on it strains the element by n (x) u/H, so that the zone's energy per area of crack is
/// that of the law whatever the element's size (Oliver 1989, doi 10.1002/nme.1620280214).
double element_length(const Triangle& t, const Eigen::Vector2d& normal) {
  double steepest = 0.0;
  for (const Eigen::Vector2d& g : t.gradient) steepest = std::max(steepest, std::abs(g.dot(normal)));
  return 1.0 / steepest;
}

/// Squares cut into two triangles, with a column of squares in the middle of which the lower ones are the notch.
struct Mesh {
  std::vector<Eigen::Vector2d> nodes;
  std::vector<Triangle> triangles;
  int columns = 0, rows = 0;  ///< of nodes

  [[nodiscard]] int node(int i, int j) const { return i * rows + j; }
  [[nodiscard]] const Eigen::Vector2d& at(int n) const { return nodes[static_cast<std::size_t>(n)]; }
};

std::vector<double> column_positions(double size) {
  std::vector<double> right;
  for (double x = 0.5 * size; x < half_length - 0.25 * size; x += size) right.push_back(x);
  right.push_back(half_length);
  std::vector<double> all(right.rbegin(), right.rend());
  for (double& x : all) x = -x;
  all.insert(all.end(), right.begin(), right.end());
  return all;
}

Triangle make_triangle(const Mesh& mesh, const std::array<int, 3>& node) {
  Triangle t;
  t.node = node;
  Eigen::Matrix3d m;
  for (int k = 0; k < 3; ++k) m.row(k) << 1.0, mesh.at(node[static_cast<std::size_t>(k)]).transpose();
  const Eigen::Matrix3d inverse = m.inverse();
  for (int k = 0; k < 3; ++k) t.gradient[static_cast<std::size_t>(k)] = inverse.block<2, 1>(1, k);
  t.area = 0.5 * std::abs(m.determinant());
  t.material = fpz::make_material(concrete(), fpz::Setting::plane_strain);
  return t;
}

Mesh make_mesh(double size) {
  Mesh mesh;
  const std::vector<double> x = column_positions(size);
  mesh.columns = static_cast<int>(x.size());
  mesh.rows = static_cast<int>(std::lround(depth / size)) + 1;
  for (const double xi : x) {
    for (int j = 0; j < mesh.rows; ++j) mesh.nodes.emplace_back(xi, depth * j / (mesh.rows - 1));
  }
  for (int i = 0; i + 1 < mesh.columns; ++i) {
    for (int j = 0; j + 1 < mesh.rows; ++j) {
      const bool middle = 2 * i + 2 == mesh.columns;
      if (middle && depth * (j + 0.5) / (mesh.rows - 1) < notch) continue;
      const int a = mesh.node(i, j), b = mesh.node(i + 1, j), c = mesh.node(i + 1, j + 1), d = mesh.node(i, j + 1);
      const bool rising = (i + j) % 2 == 0;  // diagonals in turn: the mesh prefers no side
      mesh.triangles.push_back(make_triangle(mesh, rising ? std::array{a, b, c} : std::array{a, b, d}));
      mesh.triangles.push_back(make_triangle(mesh, rising ? std::array{a, c, d} : std::array{b, c, d}));
    }
  }
  return mesh;
}

/// How far a step came: |residual| over the load after each iteration.
struct Convergence {
  std::vector<double> residuals;
  bool ok = false;

  /// The order p of r(k+1) = C r(k)^p from the last three residuals above rounding, where it can be told.
  [[nodiscard]] std::optional<double> order() const {
    constexpr double rounding = 1e-11, near = 0.1;
    for (std::size_t k = residuals.size(); k-- > 2;) {
      const double a = residuals[k - 2], b = residuals[k - 1], c = residuals[k];
      if (c > rounding && a < near) return std::log(c / b) / std::log(b / a);
    }
    return std::nullopt;
  }
};

class Beam {
 public:
  Beam(double size, const fpz::Options& options, bool own_planes)
      : options_(options),
        size_(size),
        own_planes_(own_planes),
        mesh_(make_mesh(size)),
        displacement_(Vector::Zero(2 * count())) {
    load_ = Vector::Zero(2 * count());
    add_pressure(mesh_.rows - 1, 0.0, -1.0);
    add_pressure(0, -half_span, 0.5);
    add_pressure(0, half_span, 0.5);
    // The load balances itself, so that holding the beam takes no force.
    const int left = mesh_.node(0, mesh_.rows - 1), right = mesh_.node(mesh_.columns - 1, mesh_.rows - 1);
    held_ = {2 * left, 2 * left + 1, 2 * right + 1};
    mouth_ = {mesh_.node(mesh_.columns / 2 - 1, 0), mesh_.node(mesh_.columns / 2, 0)};
  }

  /// Load of the beam, N.
  [[nodiscard]] double load() const { return factor_; }
  /// Opening of the notch, m.
  [[nodiscard]] double opening() const { return displacement_[2 * mouth_[1]] - displacement_[2 * mouth_[0]]; }
  /// Of the middle at half depth below the line of the supports, m.
  [[nodiscard]] double deflection() const {
    const int j = (mesh_.rows - 1) / 2, i = mesh_.columns / 2;
    const auto down = [this](int n) { return -displacement_[2 * n + 1]; };
    return 0.5 * (down(mesh_.node(i - 1, j)) + down(mesh_.node(i, j))) + under_supports();
  }
  /// Elements that have cracked, and those of them beside the middle column.
  [[nodiscard]] std::array<int, 2> cracked() const {
    std::array<int, 2> n{};
    for (const Triangle& t : mesh_.triangles) {
      if (fpz::damage(t.begin) <= 0.0) continue;
      ++n[0];
      for (const int k : t.node) {
        if (std::abs(mesh_.at(k)[0]) > mesh_.at(mouth_[1])[0] * 1.001) {
          ++n[1];
          break;
        }
      }
    }
    return n;
  }

  /// Opens the notch by `increment` (m) and finds load and displacements: K du = -r + dF load, mouth(du) = the rest of
  /// the increment (two solutions with one factorisation). On failure the beam is as it was.
  Convergence step(double increment) {
    constexpr int most_iterations = 12;
    constexpr double tolerance = 1e-10;
    const Vector old_displacement = displacement_;
    const double old_factor = factor_, target = opening() + increment;
    place_zones();
    Convergence c;
    for (int k = 0; k < most_iterations; ++k) {
      if (!assemble(displacement_ - old_displacement)) break;
      Vector residual = force_ - factor_ * load_;
      for (const int i : held_) residual[i] = 0.0;
      if (k > 0) c.residuals.push_back(residual.norm() / (std::abs(factor_) * load_.norm()));
      if (k > 0 && c.residuals.back() < tolerance) {
        c.ok = true;
        break;
      }
      solver_.factorize(stiffness_);
      if (solver_.info() != Eigen::Success) break;
      const Vector relief = solver_.solve(-residual), per_load = solver_.solve(load_);
      const double change = (target - opening() - mouth(relief)) / mouth(per_load);
      displacement_ += relief + change * per_load;
      factor_ += change;
    }
    if (c.ok) {
      for (Triangle& t : mesh_.triangles) t.begin = t.end;
    } else {
      displacement_ = old_displacement;
      factor_ = old_factor;
    }
    return c;
  }

 private:
  [[nodiscard]] int count() const { return static_cast<int>(mesh_.nodes.size()); }
  [[nodiscard]] double mouth(const Vector& u) const { return u[2 * mouth_[1]] - u[2 * mouth_[0]]; }

  /// Vertical force 1 N times `share`, even over the roller at x on row j of nodes.
  void add_pressure(int j, double x, double share) {
    for (int i = 0; i + 1 < mesh_.columns; ++i) {
      const int a = mesh_.node(i, j), b = mesh_.node(i + 1, j);
      const double xa = mesh_.at(a)[0], xb = mesh_.at(b)[0];
      const double low = std::max(xa, x - 0.5 * roller), high = std::min(xb, x + 0.5 * roller);
      if (high <= low) continue;
      const double force = share * (high - low) / roller, to_b = (0.5 * (low + high) - xa) / (xb - xa);
      load_[2 * a + 1] += force * (1.0 - to_b);
      load_[2 * b + 1] += force * to_b;
    }
  }

  /// Mean vertical displacement of the supports: what their share of the load does work on.
  [[nodiscard]] double under_supports() const {
    double sum = 0.0;
    for (int i = 0; i < mesh_.columns; ++i) {
      const int n = 2 * mesh_.node(i, 0) + 1;
      sum += load_[n] * displacement_[n];
    }
    return sum;
  }

  /// Gives every element that is close to onset a zone that is still whole, and so does nothing until it yields, on a
  /// plane that is critical for the mean stress around. A triangle's own stress has a spurious shear where a crack
  /// opens like a hinge; a zone on the plane of that stress opens across its neighbours' and locks. H belongs to the
  /// plane, and neither may change in the iterations, or the tangent would not be theirs. With `own_planes` the plane
  /// is that of the element's own stress all the same, for comparison.
  void place_zones() {
    std::vector<std::pair<Triangle*, fpz::State2>> fresh;
    const double close = 0.2 * concrete().tensile_strength;
    for (Triangle& t : mesh_.triangles) {
      const fpz::State2& s = t.begin;
      if (s.cracked || fpz::critical_plane<2>(t.material, s.stress).failure_value < -close) continue;
      fpz::State2 whole = s;
      whole.cracked = true;
      whole.frame = fpz::critical_plane<2>(t.material, own_planes_ ? s.stress : mean_stress(centre(t))).frame;
      whole.crack = fpz::cracked_at<double, 2>(t.material.law, fpz::local_traction<double, 2>(whole.frame, s.stress));
      fresh.emplace_back(&t, whole);
    }
    for (const auto& [t, whole] : fresh) {
      t->begin = whole;
      fpz::set_rve_length(t->material, element_length(*t, whole.frame.row(0).transpose()));
    }
  }

  /// Of the elements within two sizes of a point, Pa.
  [[nodiscard]] Strain mean_stress(const Eigen::Vector2d& at) const {
    Strain sum = Strain::Zero();
    double area = 0.0;
    for (const Triangle& t : mesh_.triangles) {
      if ((centre(t) - at).norm() > 2.0 * size_) continue;
      sum += t.area * t.begin.stress;
      area += t.area;
    }
    return sum / area;
  }

  [[nodiscard]] Eigen::Vector2d centre(const Triangle& t) const {
    return (mesh_.at(t.node[0]) + mesh_.at(t.node[1]) + mesh_.at(t.node[2])) / 3.0;
  }

  /// The update of an element. False when it fails, or a zone appears within it: place_zones() must come first.
  [[nodiscard]] bool update(Triangle& t, const Strain& increment, fpz::Tangent<2>& tangent) const {
    const fpz::Report report = fpz::update_with_tangent<2>(t.material, options_, t.begin, increment, t.end, tangent);
    if (!report.ok()) {
      std::cerr << "an update failed: " << fpz::to_string(report.status) << ", H = " << t.material.rve_length << " m\n";
    }
    return report.ok() && !report.onset;
  }

  /// Internal forces and stiffness when the displacements have changed by `change` since the begin of the step. False
  /// when an element's update fails, which is said.
  bool assemble(const Vector& change) {
    force_ = Vector::Zero(2 * count());
    std::vector<Eigen::Triplet<double>> entries;
    for (Triangle& t : mesh_.triangles) {
      Eigen::Matrix<double, 3, 6> b = Eigen::Matrix<double, 3, 6>::Zero();  // tensor strain of nodal displacements
      Eigen::Matrix<double, 6, 1> u;
      std::array<int, 6> dof{};
      for (int k = 0; k < 3; ++k) {
        const Eigen::Vector2d& g = t.gradient[static_cast<std::size_t>(k)];
        b.block<3, 2>(0, 2 * k) << g[0], 0.0, 0.0, g[1], 0.5 * g[1], 0.5 * g[0];
        for (int c = 0; c < 2; ++c) {
          dof[static_cast<std::size_t>(2 * k + c)] = 2 * t.node[static_cast<std::size_t>(k)] + c;
          u[2 * k + c] = change[2 * t.node[static_cast<std::size_t>(k)] + c];
        }
      }
      fpz::Tangent<2> tangent;
      if (!update(t, b * u, tangent)) return false;
      const Eigen::Vector3d twice(1.0, 1.0, 2.0);  // both shear components do work
      const Eigen::Matrix<double, 6, 3> weighted = t.area * thickness * b.transpose() * twice.asDiagonal();
      const Eigen::Matrix<double, 6, 1> f = weighted * Eigen::Vector3d(t.end.stress);
      const Eigen::Matrix<double, 6, 6> k = weighted * Eigen::Matrix3d(tangent) * b;
      for (int r = 0; r < 6; ++r) {
        force_[dof[static_cast<std::size_t>(r)]] += f[r];
        for (int c = 0; c < 6; ++c)
          add_entry(entries, dof[static_cast<std::size_t>(r)], dof[static_cast<std::size_t>(c)], k(r, c));
      }
    }
    for (const int i : held_) entries.emplace_back(i, i, concrete().young_modulus * thickness);
    const bool first = stiffness_.nonZeros() == 0;
    stiffness_.resize(2 * count(), 2 * count());
    stiffness_.setFromTriplets(entries.begin(), entries.end());
    if (first) solver_.analyzePattern(stiffness_);
    return true;
  }

  void add_entry(std::vector<Eigen::Triplet<double>>& entries, int r, int c, double x) const {
    const auto held = [this](int i) { return std::find(held_.begin(), held_.end(), i) != held_.end(); };
    entries.emplace_back(r, c, held(r) || held(c) ? 0.0 : x);
  }

  fpz::Options options_;
  double size_;
  bool own_planes_;
  Mesh mesh_;
  Vector displacement_, load_, force_;
  double factor_ = 0.0;
  std::array<int, 3> held_{};   ///< displacements that are zero
  std::array<int, 2> mouth_{};  ///< nodes on both sides of the notch
  Eigen::SparseMatrix<double> stiffness_;
  Eigen::SparseLU<Eigen::SparseMatrix<double>> solver_;
};

struct Row {
  double load, opening, deflection;
  Convergence convergence;
};

/// Follows the beam to an opening far behind the peak; steps that fail are halved.
std::optional<std::vector<Row>> follow(Beam& beam) {
  constexpr double last = 60e-6, longest = 0.5e-6, shortest = 1e-10;
  std::vector<Row> rows{{0.0, 0.0, 0.0, {}}};
  double length = longest;
  while (beam.opening() < last) {
    const Convergence c = beam.step(length);
    if (!c.ok) {
      length *= 0.5;
      if (length < shortest) return std::nullopt;
      continue;
    }
    rows.push_back({beam.load(), beam.opening(), beam.deflection(), c});
    length = std::min(2.0 * length, longest);
  }
  return rows;
}

void print_convergence(const std::vector<Row>& rows) {
  std::vector<double> orders;
  std::cout << "residual over load after each iteration (every tenth step), and the order of the last ones\n";
  for (std::size_t k = 1; k < rows.size(); ++k) {
    const Convergence& c = rows[k].convergence;
    const std::optional<double> order = c.order();
    if (order) orders.push_back(*order);
    if (k % 10 != 0) continue;
    std::printf("  CMOD %5.1f um:", 1e6 * rows[k].opening);
    for (const double r : c.residuals) std::printf(" %.1e", r);
    if (order) std::printf("   order %.2f", *order);
    std::printf("\n");
  }
  std::sort(orders.begin(), orders.end());
  if (!orders.empty()) {
    std::printf("order: median %.2f of %zu steps in which it can be told, of %zu\n", orders[orders.size() / 2],
                orders.size(), rows.size() - 1);
  }
}

bool write(const char* file, const std::vector<Row>& rows) {
  std::ofstream out(file);
  out.precision(12);
  out << "load,cmod,deflection_mid_depth,iterations,order\n";
  for (const Row& r : rows) {
    out << r.load << ',' << r.opening << ',' << r.deflection << ',' << r.convergence.residuals.size() << ',';
    if (const auto order = r.convergence.order()) out << *order;
    out << '\n';
  }
  return out.flush().good();
}

}  // namespace

int main(int argc, char** argv) {
  const double size = argc > 2 ? std::atof(argv[1]) : 0.0;
  fpz::Options options;
  options.tolerance = 1e-9;
  const auto method = fpz::from_word<fpz::Method>(argc > 3 ? argv[3] : "accurate");
  const double ratio = notch / size;
  if (!(size > 0.0) || std::abs(ratio - std::round(ratio)) > 1e-9 || !method) {
    std::cerr << "usage: fpz-fe-beam SIZE OUT.csv [" << fpz::all_words<fpz::Method>() << " [own_planes]]\n"
              << "SIZE of the elements in m must divide the notch, " << notch << "\n";
    return 2;
  }
  options.method = *method;
  const bool own_planes = argc > 4 && std::string_view(argv[4]) == "own_planes";
  Beam beam(size, options, own_planes);
  const auto rows = follow(beam);
  if (!rows) {
    std::cerr << "Newton's method does not come through at an opening of " << beam.opening() << " m\n";
    return 1;
  }
  print_convergence(*rows);
  const auto peak =
      std::max_element(rows->begin(), rows->end(), [](const Row& a, const Row& b) { return a.load < b.load; });
  const auto late = std::find_if(rows->begin(), rows->end(), [](const Row& r) { return r.opening >= 50e-6; });
  const auto [cracked, beside] = beam.cracked();
  std::printf(
      "elements of %g mm: peak %.1f N at CMOD %.2f um, %.1f N at %.2f um; %zu steps, %d elements cracked, %d of "
      "them beside the middle column\n",
      1e3 * size, peak->load, 1e6 * peak->opening, late->load, 1e6 * late->opening, rows->size() - 1, cracked, beside);
  if (write(argv[2], *rows)) return 0;
  std::cerr << "cannot write " << argv[2] << '\n';
  return 2;
}
