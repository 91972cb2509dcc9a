#pragma once

#include <Teuchos_ParameterList.hpp>

namespace stockwork
{
/// Settings of ML's smoothed aggregation for elliptic problems (Gee et al., ML 5.0 Smoothed
/// Aggregation User's Guide, Sandia report 2006-2649).
Teuchos::ParameterList aggregation_parameters();
} // namespace stockwork
