#include "rock/laws.h"

#include "stockwork/base/error.h"

#include "base/parameter_tree.h"
#include "rock/stress_dependent_permeability.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace stockwork
{
using namespace dealii;

namespace
{
std::string names_of(const RockLawRegistry &registry)
{
  std::string names;
  for (const auto &[name, entry] : registry.all())
    names += (names.empty() ? "" : "|") + name;
  return names;
}


/// The entries of one law, without those of anything else.
std::vector<DeclaredEntry> own_entries(const RockLawEntry &entry)
{
  ParameterHandler own;
  entry.declare_parameters(own);
  return declared_entries(own);
}


std::vector<std::string> region_sections(const types::material_id region)
{
  if (region == 0)
    return {"Rock"};
  return {"Rock", "Region " + std::to_string(region)};
}


std::string path_of(const std::vector<std::string> &sections)
{
  std::string path;
  for (const std::string &section : sections)
    path += (path.empty() ? "" : "/") + section;
  return path;
}


/// What a law reads in a region: the region's entries over those of the rock at large.
std::unique_ptr<ParameterHandler> entries_of(ParameterHandler &prm,
                                             const types::material_id region,
                                             const std::string &name,
                                             const RockLawEntry &entry)
{
  auto own = std::make_unique<ParameterHandler>();
  entry.declare_parameters(*own);
  for (const DeclaredEntry &e : declared_entries(*own))
  {
    own->set(e.name, value_of(prm, {"Rock", name}, e.name));
    auto of_region = region_sections(region);
    of_region.push_back(name);
    const std::string value = region == 0 ? "" : value_of(prm, of_region, e.name);
    if (value.empty())
      continue;
    try
    {
      own->set(e.name, value);
    }
    catch (const ExceptionBase &)
    {
      throw EntryError(path_of(of_region) + "/" + e.name, value, allowed_text(e.pattern));
    }
  }
  return own;
}
} // namespace


void RockLaws::declare_parameters(ParameterHandler &prm, const RockLawRegistry &registry)
{
  for (types::material_id region = 0; region <= Rock::max_regions; ++region)
  {
    for (const std::string &section : region_sections(region))
      prm.enter_subsection(section);
    if (region == 0)
      prm.declare_entry("Law", "elastic", Patterns::Selection(names_of(registry)),
                        "How the rock deforms.");
    else
      prm.declare_entry("Law", "", Patterns::Selection(names_of(registry) + "|"),
                        "As Rock/Law, in this region only; empty: as there.");
    for (const auto &[name, entry] : registry.all())
    {
      const std::vector<DeclaredEntry> own = own_entries(entry);
      if (own.empty())
        continue; // an empty section would be printed, and is none when it is read again
      prm.enter_subsection(name);
      if (region == 0)
        entry.declare_parameters(prm);
      else
        for (const DeclaredEntry &e : own)
          prm.declare_entry(e.name, "", Patterns::Anything(),
                            "As Rock/" + name + "/" + e.name +
                              ", in this region only; empty: as there.");
      prm.leave_subsection();
    }
    for (unsigned int i = 0; i < region_sections(region).size(); ++i)
      prm.leave_subsection();
  }
}


void RockLaws::parse_parameters(ParameterHandler &prm,
                                const RockLawRegistry &registry,
                                const std::vector<types::material_id> &regions,
                                Rock &rock)
{
  laws.clear();
  names.clear();
  std::set<types::material_id> all(regions.begin(), regions.end());
  all.insert(0);
  for (const types::material_id region : all)
  {
    const std::string name = value_of(prm, region_sections(region), "Law");
    names[region] = name.empty() ? names.at(0) : name;
  }
  refuse_unused(prm, registry);

  std::map<types::material_id, std::unique_ptr<ParameterHandler>> own;
  for (const types::material_id region : all)
    own[region] = entries_of(prm, region, names.at(region), registry.all().at(names.at(region)));
  const auto path_in = [&](const types::material_id region)
  { return path_of(region_sections(region)) + "/" + names.at(region); };
  rock.parse_parameters(prm,
                        [&](const types::material_id region, const RockProperties &properties)
                          -> std::optional<SymmetricTensor<4, 3>>
                        {
                          if (own.count(region) == 0)
                            return properties.stiffness; // the mesh has no such region
                          const RockLawEntry &entry = registry.all().at(names.at(region));
                          if (!entry.stiffness)
                            return {};
                          return entry.stiffness(*own.at(region), path_in(region), properties);
                        });
  for (const types::material_id region : all)
  {
    laws[region] =
      registry.all().at(names.at(region)).create(*own.at(region), path_in(region), rock(region));
    if (std::isfinite(rock(region).permeability_decay_stress))
      laws[region] =
        std::make_unique<StressDependentPermeability>(std::move(laws[region]), rock(region));
  }
}


void RockLaws::refuse_unused(ParameterHandler &prm, const RockLawRegistry &registry) const
{
  for (const auto &[name, entry] : registry.all())
    for (const DeclaredEntry &e : own_entries(entry))
      for (const auto &[region, law_here] : names)
      {
        auto sections = region_sections(region);
        sections.push_back(name);
        const std::string value = value_of(prm, sections, e.name);
        const bool is_given = value != (region == 0 ? e.default_value : "");
        const bool is_used = region == 0
                               ? std::any_of(names.begin(), names.end(),
                                             [&](const auto &law) { return law.second == name; })
                               : law_here == name;
        if (is_given && !is_used)
          throw EntryError(path_of(sections) + "/" + e.name, value,
                           "nothing (an empty entry), for " +
                             (region == 0 ? "no rock has the law '" + name + "': see 'Rock/Law'"
                                          : "this region has the law '" + law_here + "'"));
      }
}


bool RockLaws::are_linear() const
{
  return std::all_of(laws.begin(), laws.end(),
                     [](const auto &law) { return law.second->is_linear(); });
}


bool RockLaws::may_yield() const
{
  return std::any_of(laws.begin(), laws.end(),
                     [](const auto &law) { return law.second->n_history() > 0; });
}
} // namespace stockwork
