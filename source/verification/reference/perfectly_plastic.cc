#include "verification/reference/perfectly_plastic.h"

#include "stockwork/base/error.h"
#include "stockwork/base/quantity.h"

namespace stockwork::reference
{
void require_perfectly_plastic(const mohr_coulomb::Strength &strength, const std::string &name)
{
  const auto refuse = [&](const std::string &entry, const double value)
  {
    throw EntryError("Rock/mohr coulomb/" + entry, to_string(value, dimension::stress),
                     "nothing (an empty entry) with 'Verification/Reference = " + name +
                       "', a solution of perfectly plastic rock without cut-off");
  };
  if (strength.has_cut_off())
    refuse("Tension cut-off", strength.tension_cut_off);
  if (!strength.is_perfectly_plastic())
    refuse("Hardening modulus", strength.hardening_modulus);
}
} // namespace stockwork::reference
