#pragma once

namespace stockwork
{
/// Laws have kinks: where softening begins or goes on, where faces touch, stick or slide. A step
/// ends on one more often than not, for what has softened in it is as far as it has ever been, and
/// Newton's method begins the next one with the derivative of one side. Rounding must not choose
/// the side, or the iterations differ with the number of ranks. What is nearer to a kink than this,
/// relative to what is compared there, is on it.
constexpr double kink_width = 1e-9;
} // namespace stockwork
