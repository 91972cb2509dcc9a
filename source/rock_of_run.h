#pragma once

#include "case.h"

#include <set>
#include <string>

namespace stockwork
{
/// Before the first step. @throws EntryError for rock that yields before anything happens, and for
/// a law in cells whose stiffness the fracture model provides itself. Collective.
template <int dim>
void check_rock(const RunContext &run,
                const Case<dim> &the_case,
                const CoupledSystem<dim> &system,
                dealii::ParameterHandler &prm);

/// Warns of what laws of the rock remark on the last step, each remark once in a run. Collective.
template <int dim>
void pass_on_remarks(RunContext &run,
                     const CoupledSystem<dim> &system,
                     std::set<std::string> &passed_on);

/// After the last step: what has become of the rock's strength, for people. Collective.
template <int dim>
void say_how_far_rock_went(const RunContext &run, const CoupledSystem<dim> &system);
} // namespace stockwork
