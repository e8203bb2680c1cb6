// fpz-sph-bench: particle-steps per second of an elastic 2-D specimen (140 x 50 particles, cubic spline, h = 1.2 dx) on
// one core and on all, for both configurations and every compiled version of the inner loops; the best of several
// rounds. When LAMMPS (`lmp`) is on the PATH, the ratio to its bond-based peridynamics on the same specimen.
// --threads [busy]: 1, 2, ... threads on specimens of several sizes, round by round in turn; busy: beside a thread that
// keeps one processor busy.
// --ratio: the loops over a frozen simple one (simple_loop.hpp), round by round in turn; fails when one has lost a
// third of what it once had.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#ifdef __linux__
#include <sched.h>
#endif

#include "simple_loop.hpp"
#include "sph_cases.hpp"
#include "stopwatch.hpp"

namespace {

using namespace fpz::sph;
using fpz::bench::bar;
using fpz::bench::Layout;
using fpz::bench::seconds;

constexpr int columns = 140;
constexpr int rows = 50;
constexpr double spacing = 1e-3;  // of fpz::bench::bar

bool has_avx2() {
#if defined(__x86_64__)
  return __builtin_cpu_supports("avx2") > 0;
#else
  return false;
#endif
}

/// Particle-steps per second, best round; 0 after a failure.
double rate(const Options<2>& options, int rounds, int steps) {
  Simulation<2> run(bar(columns, rows, options));
  double best = 0.0;
  for (int r = 0; r < rounds; ++r) {
    const double begin = seconds();
    for (int k = 0; k < steps; ++k) {
      if (const Outcome o = run.step(); !o.ok()) {
        std::puts(o.message().c_str());
        return 0.0;
      }
    }
    best = std::max(best, columns * rows * steps / (seconds() - begin));
  }
  return best;
}

/// Keeps the last processor busy, as another program would.
class Neighbour {
 public:
  Neighbour()
      : thread_([this] {
#ifdef __linux__
          cpu_set_t set;
          CPU_ZERO(&set);
          CPU_SET(std::thread::hardware_concurrency() - 1, &set);
          sched_setaffinity(0, sizeof set, &set);
#endif
          while (!over_) ++rounds_;
        }) {
  }
  ~Neighbour() {
    over_ = true;
    thread_.join();
  }
  Neighbour(const Neighbour&) = delete;
  Neighbour& operator=(const Neighbour&) = delete;

 private:
  std::atomic<bool> over_{false};
  std::atomic<long> rounds_{0};
  std::thread thread_;
};

/// How the steps of larger specimens gain from threads. The numbers of threads take turns, so that other programs on
/// the machine slow all of them down alike; the best round of each counts, beside a busy neighbour all of them
/// together. False after a failure.
bool thread_scaling(int rounds, long particle_steps, bool busy) {
  std::unique_ptr<Neighbour> neighbour;
  if (busy) neighbour = std::make_unique<Neighbour>();
  const int most = std::max(2, static_cast<int>(std::thread::hardware_concurrency()));
  std::printf("particles  threads  million particle-steps per second  over one thread\n");
  for (const int scale : {1, 2, 4}) {
    const int count = columns * rows * scale * scale;
    const int steps = std::max(2, static_cast<int>(particle_steps / count));
    std::vector<std::unique_ptr<Simulation<2>>> runs;
    for (int n = 1; n <= most; ++n) {
      Options<2> o;
      o.threads = n;
      runs.push_back(std::make_unique<Simulation<2>>(bar(scale * columns, scale * rows, o)));
    }
    std::vector<double> best(runs.size(), 0.0), total(runs.size(), 0.0);
    for (int r = 0; r < rounds; ++r) {
      for (std::size_t n = 0; n < runs.size(); ++n) {
        const double begin = seconds();
        for (int k = 0; k < steps; ++k) {
          if (const Outcome o = runs[n]->step(); !o.ok()) {
            std::puts(o.message().c_str());
            return false;
          }
        }
        const double time = seconds() - begin;
        best[n] = std::max(best[n], static_cast<double>(count) * steps / time);
        total[n] += time;
      }
    }
    for (std::size_t n = 0; n < best.size(); ++n) {
      if (busy) best[n] = static_cast<double>(count) * steps * rounds / total[n];
      std::printf("%9d  %7zu  %33.2f  %15.2f\n", count, n + 1, best[n] * 1e-6, best[n] / best[0]);
    }
    std::fflush(stdout);
  }
  return true;
}

/// A version of the loops and how many times as fast as the simple loop it was when it was written (g++ 12; Zen 4,
/// 1.1 to 1.25 times that on Sapphire Rapids).
struct Known {
  Configuration configuration;
  InstructionSet set;
  Layout layout;
  double ratio;
};
constexpr Known known[] = {
    {Configuration::reference, InstructionSet::baseline, Layout::lattice, 0.69},
    {Configuration::reference, InstructionSet::avx2, Layout::lattice, 1.32},
    {Configuration::reference, InstructionSet::avx2, Layout::scattered, 0.67},
    {Configuration::updated, InstructionSet::avx2, Layout::lattice, 0.46},
};

/// Median of the ratios of rounds that follow each other, so that a loaded machine slows both alike. False when a
/// version has lost a third.
bool keeps_its_ratios() {
  constexpr int rounds = 41, steps = 12;
  fpz::bench::SimpleLoop simple(columns, rows);
  bool good = true;
  std::printf("loops over the simple one: now, once\n");
  for (const Known& k : known) {
    if (k.set != InstructionSet::baseline && !has_avx2()) continue;
    Options<2> o;
    o.configuration = k.configuration;
    o.instruction_set = k.set;
    o.threads = 1;
    Simulation<2> run(bar(columns, rows, o, k.layout));
    std::vector<double> ratios;
    for (int r = 0; r < rounds; ++r) {
      const double begin = seconds();
      for (int q = 0; q < steps; ++q) simple.step();
      const double middle = seconds();
      for (int q = 0; q < steps; ++q) good = run.step().ok() && good;
      ratios.push_back((middle - begin) / (seconds() - middle));
    }
    std::nth_element(ratios.begin(), ratios.begin() + rounds / 2, ratios.end());
    const double now = ratios[rounds / 2];
    const bool lost = now < 2.0 / 3.0 * k.ratio;
    good = good && !lost;
    std::printf("%-10s %-9s %-10s %5.2f %5.2f%s\n", fpz::to_string(k.configuration), fpz::to_string(k.set),
                name_of(k.layout), now, k.ratio, lost ? "  LOST A THIRD" : "");
  }
  if (!std::isfinite(simple.sum())) std::puts("the simple loop diverged");
  return good && std::isfinite(simple.sum());
}

/// Bond-based peridynamics of LAMMPS on the same lattice (thickness one spacing, horizon 2.4 spacings): particle-steps
/// per second of its own loop time, best of three runs, or 0 when it cannot be run.
double lammps_rate() {
  if (std::system("command -v lmp > /dev/null 2>&1") != 0) return 0.0;
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "fpz-sph-bench-lammps";
  std::filesystem::create_directories(folder);
  const std::string input = folder / "in.peri";
  const std::string log = folder / "log.peri";
  std::ofstream(input) << "units si\nboundary f f f\natom_style peri\natom_modify map array\nneighbor 0.0003 bin\n"
                       << "lattice sc " << spacing << "\nregion box block -2 " << columns + 2 << " -2 " << rows + 2
                       << " -2 2 units lattice\nregion body block -0.1 " << columns - 0.9 << " -0.1 " << rows - 0.9
                       << " -0.1 0.1 units lattice\ncreate_box 1 box\ncreate_atoms 1 region body\n"
                       << "pair_style peri/pmb\npair_coeff * * 1.0e22 " << 2.4001 * spacing << " 1.0e10 0.25\n"
                       << "set group all density 2400\nset group all volume " << spacing * spacing * spacing << "\n"
                       << "velocity all create 1e-30 4928459\nfix 1 all nve\ntimestep 1.0e-8\nthermo 1000\n"
                       << "run 200\nrun 2000\n";
  double best = 0.0;
  for (int k = 0; k < 3; ++k) {
    const std::string command =
        "OMP_NUM_THREADS=1 lmp -in " + input + " -log " + log + " -screen none > /dev/null 2>&1";
    if (std::system(command.c_str()) != 0) return best;
    std::ifstream in(log);
    for (std::string line; std::getline(in, line);) {
      double time = 0.0;
      int steps = 0;
      long atoms = 0;
      if (std::sscanf(line.c_str(), "Loop time of %lf on 1 procs for %d steps with %ld atoms", &time, &steps, &atoms) ==
              3 &&
          steps == 2000) {
        best = std::max(best, static_cast<double>(atoms) * steps / time);
      }
    }
  }
  return best;
}

}  // namespace

int main(int argc, char** argv) {
  const bool quick = argc > 1 && std::string(argv[1]) == "--quick";
  if (argc > 1 && std::string(argv[1]) == "--threads") {
    const bool busy = argc > 2 && std::string(argv[2]) == "busy";
    return thread_scaling(10, busy ? 1'500'000 : 500'000, busy) ? 0 : 1;
  }
  if (argc > 1 && std::string(argv[1]) == "--ratio") return keeps_its_ratios() ? 0 : 1;
  const int rounds = quick ? 1 : 12;
  const int steps = quick ? 10 : 200;
  std::printf("million particle-steps per second, %d particles\n%-12s %-9s %-8s %8s\n", columns * rows, "", "momentum",
              "loops", "1 thread");
  double reference = 0.0;
  for (const Configuration c : {Configuration::reference, Configuration::updated}) {
    for (const MomentumForm m : {MomentumForm::adjoint, MomentumForm::paper}) {
      for (const InstructionSet i : {InstructionSet::baseline, InstructionSet::avx2, InstructionSet::avx512}) {
        Options<2> o;
        o.configuration = c;
        o.momentum = m;
        o.instruction_set = i;
        o.threads = 1;
        const double r = rate(o, rounds, steps);
        if (r == 0.0) return 1;
        if (c == Configuration::reference) reference = std::max(reference, r);
        std::printf("%-12s %-9s %-8s %8.2f\n", fpz::to_string(c), fpz::to_string(m), fpz::to_string(i), r * 1e-6);
      }
    }
  }
  for (const Configuration c : {Configuration::reference, Configuration::updated}) {
    Options<2> o;
    o.configuration = c;
    std::printf("%-12s adjoint   all threads %8.2f\n", fpz::to_string(c), rate(o, rounds, steps) * 1e-6);
  }
  if (quick) return 0;
  const double peri = lammps_rate();
  if (peri > 0.0) {
    std::printf("LAMMPS peri/pmb, one core: %.2f; reference is %.1f times as fast\n", peri * 1e-6, reference / peri);
  } else {
    std::puts("LAMMPS (lmp) not found or failed: no comparison");
  }
  return 0;
}
