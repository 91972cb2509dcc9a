#include "base/catalogue.h"

#include "stockwork/base/deck.h"
#include "stockwork/base/error.h"

#include <algorithm>
#include <filesystem>
#include <iomanip>
#include <map>
#include <string>
#include <vector>

namespace stockwork
{
namespace fs = std::filesystem;

fs::path deck_directory()
{
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  const fs::path installed = program.parent_path() / "../share/stockwork/prm";
  return fs::is_directory(installed, error) ? installed.lexically_normal()
                                            : fs::path(STOCKWORK_PRM);
}

namespace
{
bool is_deck(const fs::path &file)
{
  return file.extension() == ".prm" && file.stem().extension() != ".part";
}
} // namespace

void print_cases(std::ostream &out)
{
  struct Entry
  {
    std::string title;
    std::vector<std::string> models;
  };
  std::map<std::string, Entry> cases; // by folder
  const fs::path directory = deck_directory();
  std::error_code error;
  for (const auto &file : fs::recursive_directory_iterator(directory, error))
    if (is_deck(file.path()))
      try
      {
        const Deck deck = Deck::read(file.path().string());
        Entry &entry = cases[fs::relative(file.path().parent_path(), directory).string()];
        entry.title = deck.peek("Title").value_or("");
        entry.models.push_back(file.path().stem().string());
      }
      catch (const InputError &)
      {
      }
  out << "Cases in " << directory.string() << ", and the decks in each\n";
  for (auto &[name, entry] : cases)
  {
    std::sort(entry.models.begin(), entry.models.end());
    out << "  " << std::left << std::setw(32) << name << ' ' << entry.title << " (";
    for (const std::string &model : entry.models)
      out << (model == entry.models.front() ? "" : ", ") << model;
    out << ")\n";
  }
  if (cases.empty())
    out << "  none found\n";
}
} // namespace stockwork
