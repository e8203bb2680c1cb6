// A UMAT call as a finite-element code makes it, for the tests. Everything that the interface must not read is NaN.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <vector>

extern "C" void umat_(double* stress, double* statev, double* ddsdde, double* sse, double* spd, double* scd,
                      double* rpl, double* ddsddt, double* drplde, double* drpldt, const double* stran,
                      const double* dstran, const double* time, const double* dtime, const double* temp,
                      const double* dtemp, const double* predef, const double* dpred, const char* cmname,
                      const int* ndi, const int* nshr, const int* ntens, const int* nstatv, const double* props,
                      const int* nprops, const double* coords, const double* drot, double* pnewdt, const double* celent,
                      const double* dfgrd0, const double* dfgrd1, const int* noel, const int* npt, const int* layer,
                      const int* kspt, const int* kstep, const int* kinc, std::size_t length_of_cmname);

namespace fpz::test {

struct Umat {
  static constexpr double untouched = 3.75;
  static constexpr double poison = std::numeric_limits<double>::quiet_NaN();

  int ndi = 3;
  int nshr = 1;
  int ntens = 4;
  int nstatv = 40;
  int noel = 12;
  int npt = 3;
  double celent = poison;
  double pnewdt = untouched;
  double sse = poison;
  double spd = poison;
  std::vector<double> props;
  std::array<double, 6> stress{};
  std::array<double, 40> statev{};
  std::array<double, 36> ddsdde{};
  std::array<double, 9> drot = {1, 0, 0, 0, 1, 0, 0, 0, 1};

  Umat(int normal, int shear, std::vector<double> list)
      : ndi(normal), nshr(shear), ntens(normal + shear), props(std::move(list)) {
    ddsdde.fill(poison);
  }

  void call(const std::array<double, 6>& dstran) {
    std::array<double, 9> no;
    no.fill(poison);
    const int none = -999;
    const int nprops = static_cast<int>(props.size());
    umat_(stress.data(), statev.data(), ddsdde.data(), &sse, &spd, no.data(), no.data(), no.data(), no.data(),
          no.data(), no.data(), dstran.data(), no.data(), no.data(), no.data(), no.data(), no.data(), no.data(),
          nullptr, &ndi, &nshr, &ntens, &nstatv, props.data(), &nprops, no.data(), drot.data(), &pnewdt, &celent,
          no.data(), no.data(), &noel, &npt, &none, &none, &none, &none, 80);
  }

  [[nodiscard]] double tangent(int i, int j) const { return ddsdde[static_cast<std::size_t>(j * ntens + i)]; }
  [[nodiscard]] bool failed() const { return pnewdt != untouched; }
};

}  // namespace fpz::test
