// fpz-sph-performance FILE.md [--long]: where the time of the particle method's steps goes, as a document. --long: one
// million particles too. --quick: hardly measures, to see that it runs. --section NAME: that one alone.
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <functional>
#include <memory>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "chunks.hpp"
#include "engine.hpp"
#include "machine_peaks.hpp"
#include "sph_cases.hpp"
#include "stopwatch.hpp"

namespace {

using namespace fpz::sph;
using fpz::bench::bar;
using fpz::bench::Layout;
using fpz::bench::seconds;

struct Effort {
  int rounds = 8;
  double particle_steps = 2e6;  ///< of a round
  bool is_long = false;
};

/// Least time of one call of f over several rounds, s; `count` particles.
double least_time(const Effort& effort, std::size_t count, const std::function<void()>& f) {
  const int calls = std::max(1, static_cast<int>(effort.particle_steps / static_cast<double>(count)));
  double best = HUGE_VAL;
  for (int r = 0; r < effort.rounds; ++r) {
    const double begin = seconds();
    for (int k = 0; k < calls; ++k) f();
    best = std::min(best, (seconds() - begin) / calls);
  }
  return best;
}

struct InTurn {
  double first;   ///< least time of a call of the first, s
  double slower;  ///< median over the rounds of the second's time over the first's
};

/// Two functions in turn, round by round, so that other programs on the machine slow both alike.
InTurn in_turn(const Effort& effort, std::size_t count, const std::function<void()>& f,
               const std::function<void()>& g) {
  const int calls = std::max(1, static_cast<int>(effort.particle_steps / static_cast<double>(count) / 4.0));
  InTurn t{HUGE_VAL, 0.0};
  std::vector<double> ratios;
  for (int r = 0; r < 4 * effort.rounds; ++r) {
    const double begin = seconds();
    for (int k = 0; k < calls; ++k) f();
    const double middle = seconds();
    for (int k = 0; k < calls; ++k) g();
    t.first = std::min(t.first, (middle - begin) / calls);
    ratios.push_back((seconds() - middle) / (middle - begin));
  }
  std::nth_element(ratios.begin(), ratios.begin() + 2 * effort.rounds, ratios.end());
  t.slower = ratios[2 * static_cast<std::size_t>(effort.rounds)];
  return t;
}

void must(const Outcome& o) {
  if (o.ok()) return;
  std::fprintf(stderr, "fpz-sph-performance: %s\n", o.message().c_str());
  std::exit(1);
}

std::string text(const char* format, double x) {
  char line[64];
  std::snprintf(line, sizeof line, format, x);
  return line;
}

std::string processor() {
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);) {
    if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
  }
  return "unknown processor";
}

int all_threads() { return std::max(1, static_cast<int>(std::thread::hardware_concurrency())); }

struct Size {
  int columns, rows;
};

std::vector<Size> sizes(const Effort& effort) {
  std::vector<Size> all = {{140, 50}};
  if (effort.rounds > 1) all.push_back({560, 200});
  if (effort.is_long) all.push_back({1680, 600});
  return all;
}

Options<2> with_threads(int threads, InstructionSet set = InstructionSet::best) {
  Options<2> o;
  o.threads = threads;
  o.instruction_set = set;
  return o;
}

/// Arithmetic and traffic of a particle's step as the loops of passes.inl have them.
struct Cost {
  double bonds = 0.0, control_bonds = 0.0, shared = 0.0;  ///< of a particle; part of the blocks with a stencil
  double flops = 0.0, bytes = 0.0;
};

Cost cost_of(const detail::Engine<2>& e) {
  // Per bond in strain_reference and force_reference, with and without the zero-energy control; per particle the rest.
  constexpr double strain = 10.0, force = 12.0, control = 10.0 + 23.0, rest = 150.0;
  // Numbers of a particle that are read or written: once in each pass, what is both counts twice.
  constexpr double fields = 58.0 * 8.0;
  const detail::View<2>& v = e.run.view;
  const auto blocks = static_cast<double>(e.run.particles.blocks());
  const auto columns = [&](const detail::BondView<2>& b) {
    return static_cast<double>(b.column[e.run.particles.blocks()]);
  };
  const auto own_columns = [&](const detail::BondView<2>& b) {
    double sum = 0.0;
    for (std::size_t k = 0; k < e.run.particles.blocks(); ++k)
      sum += b.shared[k] < 0 ? b.column[k + 1] - b.column[k] : 0;
    return sum;
  };
  Cost c;
  c.bonds = columns(v.bonds) / blocks;
  c.control_bonds = columns(v.control_bonds) / blocks;
  for (std::size_t k = 0; k < e.run.particles.blocks(); ++k) c.shared += v.bonds.shared[k] >= 0 ? 1.0 / blocks : 0.0;
  c.flops = c.bonds * (strain + force) + c.control_bonds * control + rest;
  // Both passes read the bonds: vectors, in the control the stiffness too, and the neighbours.
  c.bytes = fields + 2.0 * (own_columns(v.bonds) * (16.0 + 4.0) + own_columns(v.control_bonds) * (24.0 + 4.0)) / blocks;
  return c;
}

void write_machine(std::ostream& out, double flops) {
  out << "Machine: " << processor() << ", " << all_threads() << " threads; g++ " << __VERSION__ << ". One thread:\n\n"
      << "| what | peak |\n| --- | --- |\n"
      << "| multiplications and additions, not fused | " << text("%.1f", flops * 1e-9) << " Gflop/s |\n";
  for (const auto& [name, bytes] :
       {std::pair<const char*, std::size_t>{"256 KB", 256'000}, {"8 MB", 8'000'000}, {"256 MB", 256'000'000}}) {
    out << "| a = b + s c over " << name << " | " << text("%.1f", fpz::bench::bandwidth(bytes) * 1e-9) << " GB/s |\n";
  }
}

void write_rates(std::ostream& out, const Effort& effort) {
  out << "\n## Million particle-steps per second\n\n"
      << "| particles | arrangement | SSE2 | AVX2 | AVX-512 | all threads |\n| --- | --- | --- | --- | --- | --- |\n";
  for (const Size& size : sizes(effort)) {
    for (const Layout layout : {Layout::lattice, Layout::turned, Layout::scattered}) {
      if (size.columns > 600 && layout != Layout::lattice) continue;
      std::size_t count = 0;
      const auto rate = [&](const Options<2>& o) {
        Simulation<2> run(bar(size.columns, size.rows, o, layout));
        count = run.count();
        return static_cast<double>(count) * 1e-6 / least_time(effort, count, [&] { must(run.step()); });
      };
      std::string row;
      for (const InstructionSet set : {InstructionSet::baseline, InstructionSet::avx2, InstructionSet::avx512}) {
        row += text("%.1f | ", rate(with_threads(1, set)));
      }
      row += text("%.1f |", rate(with_threads(all_threads())));
      out << "| " << count << " | " << fpz::bench::name_of(layout) << " | " << row << "\n" << std::flush;
    }
  }
}

/// Times of one thread in ns per particle, on the whole step and on its two passes alone.
void write_parts(std::ostream& out, const Effort& effort, double flops) {
  out << "\n## Where the time goes\n\n"
      << "One thread, widest registers; lattice and scattered, the passes timed alone. \"Rest\": library updates,\n"
         "boundaries, checks. Flops and bytes as the loops state them; of the peak: arithmetic.\n\n"
      << "| particles | arrangement | stencils | flops | bytes | step, ns | strain | force | rest | of the peak | GB/s "
         "|\n"
      << "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n";
  for (const Size& size : sizes(effort)) {
    for (const Layout layout : {Layout::lattice, Layout::scattered}) {
      if (size.columns > 600 && layout != Layout::lattice) continue;
      const RunSetup<2> setup = bar(size.columns, size.rows, with_threads(1), layout);
      detail::Engine<2> e(setup, time_step(setup));
      const std::size_t count = e.run.particles.count;
      const Cost cost = cost_of(e);
      const auto per_particle = [&](double time) { return time * 1e9 / static_cast<double>(count); };
      const double step = per_particle(least_time(effort, count, [&] { must(e.step()); }));
      detail::View<2> still = e.run.view;
      still.step = 0.0;
      still.lean = true;
      const auto pass = [&](auto f) {
        return per_particle(least_time(effort, count, [&] {
          e.run.for_chunks([&](detail::Index first, detail::Index last) { f(still, first, last); });
        }));
      };
      const double strain = pass(e.run.passes->strain_reference), force = pass(e.run.passes->force_reference);
      out << "| " << count << " | " << fpz::bench::name_of(layout) << " | " << text("%.0f %% | ", 100.0 * cost.shared)
          << text("%.0f | ", cost.flops) << text("%.0f | ", cost.bytes) << text("%.1f | ", step)
          << text("%.1f | ", strain) << text("%.1f | ", force) << text("%.1f | ", std::max(0.0, step - strain - force))
          << text("%.0f %% | ", 100.0 * cost.flops / step * 1e9 / flops) << text("%.1f |\n", cost.bytes / step)
          << std::flush;
    }
  }
}

/// Steps in two passes, in turn, over the same in one sweep.
void write_sweeps(std::ostream& out, const Effort& effort) {
  out << "\n## One sweep\n\n"
      << "An elastic bar, one thread: steps in two passes over steps in one sweep, in turn.\n\n"
      << "| particles | arrangement | two passes, ns | one sweep |\n"
      << "| --- | --- | --- | --- |\n";
  std::vector<Size> all = sizes(effort);
  if (effort.rounds > 1) all.push_back({1120, 400});
  for (const Size& size : all) {
    for (const Layout layout : {Layout::lattice, Layout::scattered}) {
      if (size.columns > 600 && layout != Layout::lattice) continue;
      const RunSetup<2> setup = bar(size.columns, size.rows, with_threads(1), layout);
      detail::Engine<2> e(setup, 1e-8);  // s: a tenth of what is stable
      const std::size_t count = e.run.particles.count;
      e.run.in_one_sweep = true;
      e.body->plan_sweep();
      const auto step = [&](bool in_one) {
        e.run.in_one_sweep = in_one;
        must(e.step());
      };
      const InTurn t = in_turn(
          effort, count, [&] { step(false); }, [&] { step(true); });
      out << "| " << count << " | " << fpz::bench::name_of(layout)
          << text(" | %.1f", t.first * 1e9 / static_cast<double>(count)) << text(" | %.3f |\n", 1.0 / t.slower)
          << std::flush;
    }
  }
}

/// Particles whose crack has left its first plane for good.
std::size_t opened(const Simulation<2>& run) {
  const Particles<2>& p = run.motions_now();
  std::size_t n = 0;
  for (std::size_t i = 0; i < p.count; ++i)
    n += p.kind[i] == kind::cracked && damage(p.point[i].crack) > 0.05 ? 1U : 0U;
  return n;
}

void write_cracks(std::ostream& out, const Effort& effort) {
  out << "\n## With cracks\n\n"
      << "A lattice whose every twentieth column has cracked and yields on, against the same before it cracked, in "
         "turn;\n"
         "part: of the intact rate, as measured and as it would be with 5 % cracked.\n\n"
      << "| particles | cracked | intact | part | at 5 % | a cracked particle costs, ns |\n"
      << "| --- | --- | --- | --- | --- | --- |\n";
  for (const Size& size : sizes(effort)) {
    if (size.columns > 600) continue;
    Options<2> o = with_threads(1);
    o.courant = 0.5;
    const RunSetup<2> setup = fpz::bench::bar_with_cracks(size.columns, size.rows, o);
    RunSetup<2> still = setup;
    still.groups[1].drive[0] = Motion{0.0, 0.0};
    Simulation<2> whole(still), run(setup);
    const std::size_t count = run.count();
    for (int k = 0; k < 20000 && opened(run) < count / 25; k += 20) {
      for (int q = 0; q < 20; ++q) must(run.step());
    }
    const auto [intact, slower] = in_turn(
        effort, count, [&] { must(whole.step()); }, [&] { must(run.step()); });
    const double part = static_cast<double>(run.cracked()) / static_cast<double>(count);
    const double each = (slower - 1.0) / std::max(part, 1.0 / static_cast<double>(count));
    out << "| " << count << " | " << text("%.1f %% | ", 100.0 * part)
        << text("%.1f | ", static_cast<double>(count) * 1e-6 / intact) << text("%.0f %% | ", 100.0 / slower)
        << text("%.0f %% | ", 100.0 / (1.0 + 0.05 * each))
        << text("%.0f |\n", each * intact * 1e9 / static_cast<double>(count)) << std::flush;
  }
}

}  // namespace

int main(int argc, char** argv) {
  Effort effort;
  std::string file, section;
  bool understood = true;
  for (int k = 1; k < argc; ++k) {
    const std::string word = argv[k];
    if (word == "--long") {
      effort.is_long = true;
    } else if (word == "--quick") {
      effort.rounds = 1;
      effort.particle_steps = 14'000.0;
    } else if (word == "--section" && k + 1 < argc) {
      section = argv[++k];
    } else if (file.empty() && word[0] != '-') {
      file = word;
    } else {
      understood = false;
    }
  }
  const double flops = fpz::bench::arithmetic();
  const std::vector<std::pair<std::string, std::function<void(std::ostream&)>>> sections = {
      {"machine", [&](std::ostream& out) { write_machine(out, flops); }},
      {"rates", [&](std::ostream& out) { write_rates(out, effort); }},
      {"parts", [&](std::ostream& out) { write_parts(out, effort, flops); }},
      {"sweeps", [&](std::ostream& out) { write_sweeps(out, effort); }},
      {"cracks", [&](std::ostream& out) { write_cracks(out, effort); }}};
  const auto wanted = [&](const auto& s) { return section.empty() || s.first == section; };
  if (!understood || file.empty() || std::none_of(sections.begin(), sections.end(), wanted)) {
    std::fputs("usage: fpz-sph-performance FILE.md [--long] [--quick] [--section NAME]; sections:", stderr);
    for (const auto& s : sections) std::fprintf(stderr, " %s", s.first.c_str());
    std::fputs("\n", stderr);
    return 2;
  }
  std::ostringstream out;
  if (section.empty()) {
    out << "# Speed of the particle method\n\nWritten by `build/release/bin/fpz-sph-performance docs/performance.md"
        << (effort.is_long ? " --long" : "")
        << "`. The bar of `fpz-sph-bench`:\n`reference`, consistent gradients, h = 1.2 "
        << "spacings, zero-energy control on, elastic unless it says otherwise;\nscattered: moved by 0.15 spacings, "
           "gradients of the kernel.\n\n";
  }
  for (const auto& s : sections) {
    if (wanted(s)) s.second(out);
  }
  std::ofstream to(file);
  to << out.str();
  if (!to.flush()) {
    std::fprintf(stderr, "fpz-sph-performance: %s cannot be written\n", file.c_str());
    return 1;
  }
  return 0;
}
