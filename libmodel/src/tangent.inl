// update_with_tangent() (tangent.hpp): the update once in doubles, once in dual numbers.
#include "fpz/tangent.hpp"
#include "fpz/update_any_scalar.hpp"

namespace fpz {

template <int Dim>
[[nodiscard]] Report update_with_tangent(const Material<double>& m, const Options& o, const State<double, Dim>& begin,
                                         const Tensor<double, Dim>& dstrain, State<double, Dim>& end,
                                         Tangent<Dim>& tangent) {
  constexpr int N = tensor_size<Dim>;
  State<double, Dim> out;
  const Report report = detail::update_any<Dim>(m, o, begin, dstrain, out);
  if (!report.ok()) {
    end = State<double, Dim>(begin);
    return report;
  }
  if (!out.cracked) {
    tangent = elastic_tangent<Dim>(m.bulk);
  } else if (begin.cracked) {
    // The plane is fixed: only the local drive (Dim numbers) carries derivatives. dsigma = a0 deps - a0:sym(n (x)
    // dU)/H.
    using D = Dual<Dim>;
    const CohesiveState<D, Dim> crack = lift<D>(begin.crack);
    const Vec<double, Dim> d1 = detail::drive<double, Dim>(m, begin.frame, out.strain);
    Drive<D, Dim> way;
    way.from = convert<D>(detail::drive<double, Dim>(m, begin.frame, begin.strain));
    for (int k = 0; k < Dim; ++k) way.to[k] = D::seed(d1[k], k);
    CohesiveState<D, Dim> result;
    const Report again = integrate_cohesive(Zone(m.law, m.series), o, crack, way, result);
    if (!again.ok()) {
      end = State<double, Dim>(begin);
      return again;
    }
    Mat<double, N, Dim> spread;   // column k: a0 : sym(n (x) r_k), Pa m per unit local jump
    Mat<double, Dim, N> collect;  // row k: d(drive_k)/d(strain)
    const Vec<double, Dim> n = begin.frame.row(0).transpose();
    for (int k = 0; k < Dim; ++k) {
      const Vec<double, Dim> r = begin.frame.row(k).transpose();
      spread.col(k) = m.bulk.stress<double, Dim>(symmetric_product<double, Dim>(n, r));
      collect.row(k) = spread.col(k).transpose() * (k == 0 ? m.series.normal : m.series.shear);
    }
    collect.template rightCols<N - Dim>() *= 2.0;  // a tensor shear component enters twice
    Mat<double, Dim, Dim> jump_by_drive;
    for (int k = 0; k < Dim; ++k) jump_by_drive.row(k) = result.jump[k].grad.transpose();
    tangent = elastic_tangent<Dim>(m.bulk) - spread * jump_by_drive * collect * m.inverse_length;
  } else {
    using D = Dual<N>;
    State<D, Dim> lifted;
    lifted.strain = convert<D>(begin.strain);
    lifted.stress = convert<D>(begin.stress);
    Tensor<D, Dim> seeded;
    for (int k = 0; k < N; ++k) seeded[k] = D::seed(dstrain[k], k);
    State<D, Dim> result;
    const Report again = detail::update_any<Dim>(m, o, lifted, seeded, result);
    if (!again.ok()) {
      end = State<double, Dim>(begin);
      return again;
    }
    for (int k = 0; k < N; ++k) tangent.row(k) = result.stress[k].grad.transpose();
  }
  end = out;
  return report;
}

}  // namespace fpz
