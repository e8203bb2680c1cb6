// fpz-doc-tables: brings the tables of the documentation up to date and fills paragraphs with too long lines again
// (--write), or says which tables are not what the code says (--check).
//   fpz-doc-tables --check|--write PAGE.md...
// Exit status: 0 up to date or written; 1 a table is stale or its name unknown; 2 bad usage.
#include <fstream>
#include <iostream>
#include <iterator>
#include <string_view>

#include "blocks.hpp"
#include "fpz/io/markdown.hpp"

namespace {

bool process(const std::string& file, bool write) {
  std::ifstream in(file);
  if (!in) {
    std::cerr << file << ": cannot be read\n";
    return false;
  }
  const std::string page{std::istreambuf_iterator<char>(in), {}};
  const fpz::docs::Rewritten now = fpz::docs::rewrite_blocks(page, fpz::docs::all_tables());
  for (const std::string& problem : now.problems) std::cerr << file << ": " << problem << "\n";
  bool ok = now.problems.empty();
  const std::string text = write ? fpz::io::wrap_prose(now.text) : now.text;
  if (text == page) return ok;
  if (!write) {
    std::cerr << file << ": a table is not what the code says; scripts/doc_tables.sh writes it again\n";
    return false;
  }
  std::ofstream out(file);
  out << text;
  out.close();
  std::cout << file << ": written\n";
  return ok && out.good();
}

}  // namespace

int main(int argc, char** argv) {
  const std::string_view mode = argc > 1 ? argv[1] : "";
  if (argc < 3 || (mode != "--check" && mode != "--write")) {
    std::cerr << "usage: fpz-doc-tables --check|--write PAGE.md...\n";
    return 2;
  }
  bool ok = true;
  for (int k = 2; k < argc; ++k) ok = process(argv[k], mode == "--write") && ok;
  return ok ? 0 : 1;
}
