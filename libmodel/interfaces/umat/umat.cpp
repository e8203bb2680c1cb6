// The model as an Abaqus UMAT: symbol umat_, all arguments by reference. docs/interface-umat.md says what the arguments
// mean here. Arguments that are not named below are neither read nor written.
//
// STATEV leads: it holds total strain and stress; STRESS is read for the initial stress of a fresh point, for the
// out-of-plane stress of plane strain, and to notice a caller that has changed it. STRESS and STRAN come in turned by
// DROT, STATEV does not, and is turned here. A call that fails leaves STRESS, STATEV and the energies as they were,
// sets PNEWDT, and fills DDSDDE with the elastic tangent (when there is no material: leaves it, too).
#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <exception>
#include <span>
#include <stdexcept>
#include <string>

#include "fpz/point/notice.hpp"
#include "fpz/point/point_update.hpp"

namespace {

using namespace fpz;

/// PNEWDT after a failure: a quarter of the increment, as Abaqus takes it after a divergence of its own.
constexpr double shorter_increment = 0.25;

/// The arguments that are used, under the names of the manual.
struct Call {
  double* stress;
  double* statev;
  double* ddsdde;
  double* sse;
  double* spd;
  const double* dstran;
  int ndi;
  int nshr;
  int ntens;
  int nstatv;
  std::span<const double> props;
  const double* drot;
  double* pnewdt;
  const double* celent;
  const int* noel;
  const int* npt;
};

/// Places in the UMAT's vectors of the stored components of a tensor.
template <int Dim>
struct Places {
  int of[tensor_size<Dim>];
};

template <int Dim>
Places<Dim> places(Setting setting) {
  if constexpr (Dim == 3)
    return {{0, 1, 2, 3, 4, 5}};
  else
    return setting == Setting::plane_stress ? Places<2>{{0, 1, 2}} : Places<2>{{0, 1, 3}};
}

Setting setting_of(const Call& c) {
  if (c.ntens != c.ndi + c.nshr) {
    throw std::invalid_argument("NTENS = " + std::to_string(c.ntens) +
                                ": must be NDI + NSHR = " + std::to_string(c.ndi + c.nshr));
  }
  if (c.ndi == 3 && c.nshr == 3) return Setting::three_d;
  if (c.ndi == 3 && c.nshr == 1) return Setting::plane_strain;
  if (c.ndi == 2 && c.nshr == 1) return Setting::plane_stress;
  throw std::invalid_argument("NDI = " + std::to_string(c.ndi) + ", NSHR = " + std::to_string(c.nshr) +
                              ": must be 3, 3 (solid), 3, 1 (plane strain) or 2, 1 (plane stress)");
}

/// Plane strain and axisymmetry have the same NDI and NSHR. What tells them apart is the third normal strain.
void refuse_out_of_plane_strain(const Call& c) {
  if (c.dstran[2] == 0.0) return;
  throw std::invalid_argument(
      "DSTRAN(3) = " + std::to_string(c.dstran[2]) +
      ": must be 0 in plane strain; axisymmetric elements, generalised plane strain and thermal "
      "strain in plane strain are not known to this model: use solid elements");
}

const point::Behaviour& behaviour(const Call& c, Setting setting) {
  constexpr std::size_t place = material_parameter_count;
  if (c.props.size() > place && c.props[place] != 0.0) return point::behaviour_of(setting, c.props);
  try {
    return point::behaviour_of(setting, c.props, *c.celent);
  } catch (const std::invalid_argument& e) {
    throw std::invalid_argument(std::string(e.what()) + "rve_length is not in PROPS: CELENT stands for it");
  }
}

bool is_identity(const double* drot) {
  static constexpr double identity[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  return std::equal(drot, drot + 9, identity);
}

/// DROT as the rotation Q of the library, sigma' = Q sigma Q^T.
template <int Dim>
Mat<double, Dim, Dim> rotation(const double* drot) {
  Mat<double, 3, 3> q;
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 3; ++i) q(i, j) = drot[3 * j + i];
  }
  if (!point::detail::is_frame<3>(q) ||
      !(q(0, 0) * (q(1, 1) * q(2, 2) - q(1, 2) * q(2, 1)) - q(0, 1) * (q(1, 0) * q(2, 2) - q(1, 2) * q(2, 0)) +
            q(0, 2) * (q(1, 0) * q(2, 1) - q(1, 1) * q(2, 0)) >
        0.0)) {
    throw std::invalid_argument("DROT is not a rotation");
  }
  if (Dim == 2 && !(q(2, 2) > 1.0 - 1e-6)) throw std::invalid_argument("DROT does not turn about the third axis");
  return Mat<double, Dim, Dim>(q.topLeftCorner<Dim, Dim>());
}

template <int Dim>
Tensor<double, Dim> given_stress(const Call& c, const Places<Dim>& at) {
  Tensor<double, Dim> s;
  for (int k = 0; k < tensor_size<Dim>; ++k) s[k] = c.stress[at.of[k]];
  return s;
}

template <int Dim>
bool is_fresh(const State<double, Dim>& s) {
  return !s.cracked && s.strain.isZero(0.0) && s.stress.isZero(0.0);
}

/// The state of a fresh point with an initial stress: strained elastically from nothing.
template <int Dim>
State<double, Dim> stressed(const point::Behaviour& b, const Tensor<double, Dim>& stress) {
  State<double, Dim> s;
  const Tensor<double, Dim> strain = elastic_strain<Dim>(b.material.bulk, stress);
  if (!point::update_point<Dim>(b, State<double, Dim>{}, strain, s, nullptr).ok() || s.cracked) {
    throw std::invalid_argument("the initial STRESS of a fresh point is not finite, or beyond the onset of fracture");
  }
  return s;
}

/// A caller whose STRESS is not that of the state expects something that does not happen.
template <int Dim>
void notice_other_stress(const point::Behaviour& b, const State<double, Dim>& s, const Tensor<double, Dim>& given) {
  static std::atomic<bool> noticed{false};
  const double size = std::max(b.parameters.tensile_strength, s.stress.template lpNorm<Eigen::Infinity>());
  if ((given - s.stress).template lpNorm<Eigen::Infinity>() <= 1e-4 * size || noticed.exchange(true)) return;
  point::notice(
      "umat: STRESS is not the stress of the state in STATEV; STATEV leads. Has the program changed STRESS or turned "
      "it "
      "otherwise than by DROT?");
}

template <int Dim>
void read_begin(const Call& c, const point::Behaviour& b, const Places<Dim>& at, State<double, Dim>& s) {
  if (c.nstatv < static_cast<int>(point::state_size<Dim>)) {
    throw std::invalid_argument("NSTATV = " + std::to_string(c.nstatv) + ": must be at least " +
                                std::to_string(point::state_size<Dim>));
  }
  if (!point::load<Dim>(c.statev, 1, s)) throw std::invalid_argument(point::not_a_state);
  const Tensor<double, Dim> given = given_stress<Dim>(c, at);
  if (is_fresh(s)) {
    if (!given.isZero(0.0)) s = stressed<Dim>(b, given);
    return;
  }
  if (!is_identity(c.drot)) rotate(s, rotation<Dim>(c.drot));
  notice_other_stress<Dim>(b, s, given);
}

template <int Dim>
Tensor<double, Dim> strain_increment(const Call& c, const Places<Dim>& at) {
  Tensor<double, Dim> e;
  for (int k = 0; k < tensor_size<Dim>; ++k) e[k] = c.dstran[at.of[k]] * (k < Dim ? 1.0 : 0.5);
  return e;
}

/// DDSDDE, d(stress)/d(engineering strain), by columns. In plane strain the third row and column are those of a small
/// out-of-plane strain e: it moves the zone as the in-plane strains nu e would, since the plane contains that axis.
template <int Dim>
void write_tangent(const Call& c, const point::Behaviour& b, const Places<Dim>& at, const Tangent<Dim>& t) {
  const auto entry = [&c](int i, int j) -> double& { return c.ddsdde[j * c.ntens + i]; };
  for (int j = 0; j < tensor_size<Dim>; ++j) {
    for (int i = 0; i < tensor_size<Dim>; ++i) entry(at.of[i], at.of[j]) = t(i, j) * (j < Dim ? 1.0 : 0.5);
  }
  if (b.setting != Setting::plane_strain) return;
  const double nu = b.parameters.poisson_ratio;
  for (const int k : at.of) {
    entry(2, k) = nu * (entry(0, k) + entry(1, k));
    entry(k, 2) = nu * (entry(k, 0) + entry(k, 1));
  }
  entry(2, 2) = b.parameters.young_modulus + nu * (entry(0, 2) + entry(1, 2));
}

/// In plane strain the out-of-plane stress follows the in-plane one from where the caller has it: an initial stress may
/// have any.
template <int Dim>
void write_stress(const Call& c, const point::Behaviour& b, const Places<Dim>& at, const State<double, Dim>& begin,
                  const State<double, Dim>& end) {
  for (int k = 0; k < tensor_size<Dim>; ++k) c.stress[at.of[k]] = end.stress[k];
  if (b.setting != Setting::plane_strain) return;
  c.stress[2] += b.parameters.poisson_ratio * (end.stress[0] - begin.stress[0] + end.stress[1] - begin.stress[1]);
}

/// The update with a known material. All that may fail comes before anything is written.
template <int Dim>
void update_with(const Call& c, const point::Behaviour& b, const Places<Dim>& at) {
  State<double, Dim> begin, end;
  read_begin<Dim>(c, b, at, begin);
  Tangent<Dim> tangent;
  const point::Outcome out = point::update_point<Dim>(b, begin, strain_increment<Dim>(c, at), end, &tangent);
  if (!out.ok()) throw std::runtime_error(point::last_message());
  write_tangent<Dim>(c, b, at, tangent);
  write_stress<Dim>(c, b, at, begin, end);
  point::store<Dim>(end, c.statev, 1);
  *c.sse = out.stored_energy;
  *c.spd = out.dissipated_energy;
}

/// The same for a setting; a failure leaves the elastic tangent.
template <int Dim>
void update(const Call& c, Setting setting) {
  const Places<Dim> at = places<Dim>(setting);
  const point::Behaviour& b = behaviour(c, setting);
  try {
    if (setting == Setting::plane_strain) refuse_out_of_plane_strain(c);
    update_with<Dim>(c, b, at);
  } catch (...) {
    write_tangent<Dim>(c, b, at, elastic_tangent<Dim>(b.material.bulk));
    throw;
  }
}

void update(const Call& c) {
  const Setting setting = setting_of(c);
  if (setting == Setting::three_d) {
    update<3>(c, setting);
  } else {
    update<2>(c, setting);
  }
}

}  // namespace

extern "C" __attribute__((visibility("default"))) void umat_(
    double* stress, double* statev, double* ddsdde, double* sse, double* spd, double* /*scd*/, double* /*rpl*/,
    double* /*ddsddt*/, double* /*drplde*/, double* /*drpldt*/, const double* /*stran*/, const double* dstran,
    const double* /*time*/, const double* /*dtime*/, const double* /*temp*/, const double* /*dtemp*/,
    const double* /*predef*/, const double* /*dpred*/, const char* /*cmname*/, const int* ndi, const int* nshr,
    const int* ntens, const int* nstatv, const double* props, const int* nprops, const double* /*coords*/,
    const double* drot, double* pnewdt, const double* celent, const double* /*dfgrd0*/, const double* /*dfgrd1*/,
    const int* noel, const int* npt, const int* /*layer*/, const int* /*kspt*/, const int* /*kstep*/,
    const int* /*kinc*/, std::size_t /*length of cmname*/) {
  const std::size_t size = *nprops > 0 ? static_cast<std::size_t>(*nprops) : 0;
  const Call c{stress, statev,  ddsdde,        sse,  spd,    dstran, *ndi, *nshr,
               *ntens, *nstatv, {props, size}, drot, pnewdt, celent, noel, npt};
  try {
    update(c);
  } catch (const std::exception& e) {
    *pnewdt = shorter_increment;
    try {
      point::notice("umat, element " + std::to_string(*noel) + ", point " + std::to_string(*npt) + ": " + e.what());
    } catch (...) {  // no memory for the text
    }
  }
}
