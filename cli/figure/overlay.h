// What is laid over a rendered figure: how much of each pixel the particles cover, lines of the simulation box that go
// behind them, and outlines.
#pragma once

#include "cli/figure/first_hits.h"
#include "cli/figure/screen.h"
#include "cli/layout/balls.h"

#include <cstdint>
#include <span>
#include <vector>

namespace cli {

struct Segment {
    glm::dvec3 begin;
    glm::dvec3 end;
};

// Shares of each pixel, from 0 to 1.
struct Overlay {
    explicit Overlay(std::size_t pixel_count) : particles(pixel_count), lines(pixel_count), outlines(pixel_count) {}

    std::vector<float> particles;
    std::vector<float> lines;
    std::vector<float> outlines;
};

// The objects that are particles: numbers from first on, as PT_QUANTITY_OBJECT counts them.
struct ParticleObjects {
    std::uint32_t first;
    std::uint32_t count;

    bool contains(std::uint32_t object) const { return object - first < count; }
};

// How many rows of the picture beside the wanted ones a band needs for outlines of this width, in pixels.
std::uint32_t outline_margin(double line_width);

// All add to the wanted rows of the band.
//
// The share of hits that are particles'.
void add_particles(const FirstHits &hits, const ParticleObjects &particles, Overlay &overlay);

// Segments of this width, in pixels, where nothing is before them.
void add_lines(const FirstHits &hits, const Screen &screen, std::span<const Segment> segments, double line_width,
               Overlay &overlay);

// Lines at the edges of balls: where what is behind is farther by more than a tenth of the radius, or is no ball. Balls
// that are not much larger than the line have none, as they would be all outline.
void add_outlines(const FirstHits &hits, const Screen &screen, const Balls &balls, const ParticleObjects &particles,
                  double line_width, Overlay &overlay);

} // namespace cli
