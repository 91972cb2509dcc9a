#pragma once

#include "case.h"
#include "cost_estimate.h"
#include "verification/analytical/kgd_leak_off.h"

namespace stockwork
{
/// Of the run [s].
template <int dim>
double duration_of(const Case<dim> &the_case);

/// Whether there are cracks, and a fracture model that takes them.
template <int dim>
bool is_cracked(const Case<dim> &the_case);

template <int dim>
CostlyPhysics costly_physics(const Case<dim> &the_case);

/// Of the domain's bounding box [m].
template <int dim>
double smallest_extent(const Case<dim> &the_case);

/// Distance of the first crack's mouth or middle to the walls that are not symmetry planes through
/// it, the smallest over the directions [m].
template <int dim>
double distance_to_walls(const Case<dim> &the_case);

/// Half length or radius of a crack, of which symmetry may show one half [m].
template <int dim>
double half_length(const Case<dim> &the_case, const InitialCrack<dim> &crack);

/// Of the first crack.
template <int dim>
double half_length_at_start(const Case<dim> &the_case);

/// Whether the first crack begins on a side of the domain, or has its middle there, that is no
/// plane of symmetry: then it is an edge crack, not half of one.
template <int dim>
bool begins_on_an_edge(const Case<dim> &the_case);

/// Whether a well drives the first fracture on, through rock whose toughness the deck gives.
template <int dim>
bool is_driven_on(const Case<dim> &the_case);

/// Half length or radius of the first fracture when the run ends [m]: where it is driven on, of the
/// plane-strain fracture with leak-off when its pumping ends, or the radius of the radial one in
/// impermeable rock; or of its crack, if that is longer, or nothing drives it. NaN: nothing tells
/// it.
template <int dim>
double half_length_at_end(const Case<dim> &the_case);

/// What walls change the stress intensity of a crack of this half length by, as a share of it. A
/// crack of half length a between rollers has K/K_inf = 0.996 with walls at 20 a (all round), 0.945
/// at 5 a and 0.84 at 2.5 a: 1 - (1 to 1.6) (a/d)^2. The stress of a disc falls by the cube.
template <int dim>
double effect_of_walls(double distance, double half_length);

/// On the first fracture when the run ends; 0 where nothing tells how long it is.
template <int dim>
double effect_of_walls(const Case<dim> &the_case);

/// 1/M + alpha^2/(lambda + 2 G): of rock that is held sideways [1/Pa].
double storage_coefficient(const RockProperties &rock);

/// What the first well pumps until it is shut in, or until the run ends.
struct Pumping
{
  double duration = 0.; // s
  double rate = 0.;     // its mean, of the whole well [m^2/s]
  bool is_shut_in = false;
};

template <int dim>
Pumping first_pumping(const Case<dim> &the_case);

/// Whether what the wells are given does not change in time.
template <int dim>
bool wells_are_constant(const Case<dim> &the_case);

/// Of the first crack, as the deck's law of leak-off has it. Where the flow in the rock is
/// resolved, and in one dimension: C = (p_f - p_0) sqrt(k S/(pi mu)), with S of rock that is held
/// sideways (Howard & Fast 1957).
analytical::LeakOffCoefficient leak_off_coefficient(const Case<2> &the_case);

/// Share of the fluid that leaks off until the end of pumping.
struct LeakedShare
{
  double least; ///< by flow in one dimension; the charts of models go by it
  double most;  ///< with flow around the tips, and the back stress of swollen rock at its greatest
};

/// Of the plane-strain fracture that this pumping drives. By Carter's law with a given coefficient
/// both are the same.
LeakedShare leaked_share(const Case<2> &the_case, const Pumping &pumping);

/// "about 25 %", or from the least to the most, with what makes the difference.
std::string in_words(const LeakedShare &share);

/// The plane-strain fracture that the first well drives, in impermeable rock.
analytical::KgdParameters plane_fracture(const Case<2> &the_case, const Pumping &pumping);

/// The radial one.
analytical::KgdParameters radial_fracture(const Case<3> &the_case, const Pumping &pumping);

/// c_v = k / (mu S) of the rock in a region [m^2/s].
template <int dim>
double pressure_diffusivity(const Case<dim> &the_case, dealii::types::material_id region = 0);
} // namespace stockwork
