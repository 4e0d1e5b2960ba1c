#include "cli/figure/overlay.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cli {
namespace {

constexpr float share_of_hit = 1.0F / (hits_per_side * hits_per_side);

// Index in the picture of the pixel of a hit.
std::size_t pixel_of(const FirstHits &hits, std::size_t row, std::size_t column) {
    return (hits.first_row + row / hits_per_side) * hits.width + column / hits_per_side;
}

// A range of rows or columns of hits whose centres may be between two places, in hits.
struct HitRange {
    std::size_t first;
    std::size_t end;
};

HitRange hits_between(double low, double high, std::size_t count) {
    const double last = static_cast<double>(count);
    return {static_cast<std::size_t>(std::clamp(std::floor(low), 0.0, last)),
            static_cast<std::size_t>(std::clamp(std::ceil(high) + 1.0, 0.0, last))};
}

// One segment in the plane of the picture, whose unit is a hit and whose first row is that of the band.
class ProjectedSegment {
public:
    ProjectedSegment(const FirstHits &hits, const Screen &screen, const Segment &segment) :
        begin_(in_hits(hits, screen.project(segment.begin))),
        end_(in_hits(hits, screen.project(segment.end))),
        is_perspective_(screen.is_perspective()) {}

    HitRange rows(double radius, std::size_t count) const {
        const auto [low, high] = std::minmax(begin_.y, end_.y);
        return hits_between(low - radius, high + radius, count);
    }

    // Of a row, which the line and what is nearer to it than radius passes: the strip of that width cuts the row in a
    // range that is no longer than the row's height and the radius make it.
    HitRange columns(double y, double radius, std::size_t count) const {
        const double dx = end_.x - begin_.x;
        const double dy = end_.y - begin_.y;
        double low = std::min(begin_.x, end_.x);
        double high = std::max(begin_.x, end_.x);
        if (std::abs(dy) > 1e-9) {
            const double middle = begin_.x + dx * (y - begin_.y) / dy;
            const double reach = radius * std::hypot(dx, dy) / std::abs(dy);
            low = std::max(low, middle - reach);
            high = std::min(high, middle + reach);
        }
        return hits_between(low - radius, high + radius, count);
    }

    // Depth of the point of the segment that is nearest to the place in the picture; infinite if that is farther than
    // radius. Along a straight line of the picture the inverse of the depth is linear in a perspective (Blinn 1992,
    // "Hyperbolic interpolation"), and the depth itself in an orthographic view.
    double depth_at(double x, double y, double radius) const {
        const double dx = end_.x - begin_.x;
        const double dy = end_.y - begin_.y;
        const double square = dx * dx + dy * dy;
        const double share =
            square > 0.0 ? std::clamp(((x - begin_.x) * dx + (y - begin_.y) * dy) / square, 0.0, 1.0) : 0.0;
        if (std::hypot(begin_.x + share * dx - x, begin_.y + share * dy - y) > radius) {
            return std::numeric_limits<double>::infinity();
        }
        return is_perspective_ ? 1.0 / std::lerp(1.0 / begin_.depth, 1.0 / end_.depth, share)
                               : std::lerp(begin_.depth, end_.depth, share);
    }

private:
    static ScreenPoint in_hits(const FirstHits &hits, const ScreenPoint &point) {
        return {point.x * hits_per_side, (point.y - hits.first_row) * hits_per_side, point.depth};
    }

    ScreenPoint begin_;
    ScreenPoint end_;
    bool is_perspective_;
};

// Hits that two lines cross are covered once.
void mark_line(const FirstHits &hits, const ProjectedSegment &segment, double radius, std::vector<bool> &covered) {
    constexpr double rounding = 1e-5; // of depths in float32 and of what they are computed from
    const HitRange rows = segment.rows(radius, hits.rows());
    for (std::size_t row = rows.first; row < rows.end; ++row) {
        const double y = static_cast<double>(row) + 0.5;
        const HitRange columns = segment.columns(y, radius, hits.columns());
        for (std::size_t column = columns.first; column < columns.end; ++column) {
            const std::size_t hit = row * hits.columns() + column;
            const double depth = segment.depth_at(static_cast<double>(column) + 0.5, y, radius);
            if (depth * (1.0 - rounding) <= static_cast<double>(hits.depths[hit]) && std::isfinite(depth)) {
                covered[hit] = true;
            }
        }
    }
}

// Offsets of hits within a disc.
std::vector<std::pair<int, int>> disc(double radius) {
    std::vector<std::pair<int, int>> offsets;
    const int reach = static_cast<int>(std::floor(radius));
    for (int row = -reach; row <= reach; ++row) {
        for (int column = -reach; column <= reach; ++column) {
            if (std::hypot(row, column) <= radius) {
                offsets.emplace_back(row, column);
            }
        }
    }
    return offsets;
}

// Finds the hits at which a ball ends before something that is well behind it.
class EdgeFinder {
public:
    EdgeFinder(const FirstHits &hits, const Screen &screen, const Balls &balls, const ParticleObjects &particles,
               double line_width) :
        hits_(hits),
        screen_(screen),
        balls_(balls),
        particles_(particles),
        line_width_(line_width) {}

    // Whether the one hit is of a ball whose edge is between it and the other.
    bool is_edge(std::size_t hit, std::size_t other) const {
        constexpr double least_step = 0.1;   // of the radius, behind the ball
        constexpr double least_radius = 2.5; // of a ball with an outline, in widths of the line
        const std::uint32_t object = hits_.objects[hit];
        if (object == hits_.objects[other] || !particles_.contains(object)) {
            return false;
        }
        const double depth = hits_.depths[hit];
        const double radius = balls_[object - particles_.first].radius;
        const bool is_before =
            !particles_.contains(hits_.objects[other]) || hits_.depths[other] > depth + least_step * radius;
        return is_before && radius * screen_.pixels_per_length(depth) >= least_radius * line_width_;
    }

private:
    const FirstHits &hits_;
    const Screen &screen_;
    const Balls &balls_;
    const ParticleObjects &particles_;
    double line_width_;
};

void add_covered(const FirstHits &hits, const std::vector<bool> &covered, std::vector<float> &shares) {
    for (std::size_t row = 0; row < hits.rows(); ++row) {
        for (std::size_t column = 0; column < hits.columns(); ++column) {
            if (hits.wants(row) && covered[row * hits.columns() + column]) {
                shares[pixel_of(hits, row, column)] += share_of_hit;
            }
        }
    }
}

} // namespace

std::uint32_t outline_margin(double line_width) {
    return static_cast<std::uint32_t>(std::ceil(0.5 * line_width)) + 1;
}

void add_particles(const FirstHits &hits, const ParticleObjects &particles, Overlay &overlay) {
    for (std::size_t row = 0; row < hits.rows(); ++row) {
        for (std::size_t column = 0; column < hits.columns(); ++column) {
            if (hits.wants(row) && particles.contains(hits.objects[row * hits.columns() + column])) {
                overlay.particles[pixel_of(hits, row, column)] += share_of_hit;
            }
        }
    }
}

void add_lines(const FirstHits &hits, const Screen &screen, std::span<const Segment> segments, double line_width,
               Overlay &overlay) {
    std::vector<bool> covered(hits.objects.size());
    for (const Segment &segment : segments) {
        mark_line(hits, ProjectedSegment(hits, screen, segment), 0.5 * line_width * hits_per_side, covered);
    }
    add_covered(hits, covered, overlay.lines);
}

void add_outlines(const FirstHits &hits, const Screen &screen, const Balls &balls, const ParticleObjects &particles,
                  double line_width, Overlay &overlay) {
    const EdgeFinder finder(hits, screen, balls, particles, line_width);
    const std::vector<std::pair<int, int>> stamp = disc(0.5 * line_width * hits_per_side);
    const auto rows = static_cast<std::ptrdiff_t>(hits.rows());
    const auto columns = static_cast<std::ptrdiff_t>(hits.columns());
    std::vector<bool> covered(hits.objects.size());
    const auto draw = [&](std::ptrdiff_t row, std::ptrdiff_t column) {
        for (const auto &[down, right] : stamp) {
            const std::ptrdiff_t y = row + down;
            const std::ptrdiff_t x = column + right;
            if (y >= 0 && y < rows && x >= 0 && x < columns) {
                covered[static_cast<std::size_t>(y * columns + x)] = true;
            }
        }
    };
    for (std::ptrdiff_t row = 0; row < rows; ++row) {
        for (std::ptrdiff_t column = 0; column < columns; ++column) {
            const auto hit = static_cast<std::size_t>(row * columns + column);
            const auto has_edge = [&](bool is_there, std::ptrdiff_t step) {
                return is_there &&
                       finder.is_edge(hit, static_cast<std::size_t>(static_cast<std::ptrdiff_t>(hit) + step));
            };
            if (has_edge(column > 0, -1) || has_edge(column + 1 < columns, 1) || has_edge(row > 0, -columns) ||
                has_edge(row + 1 < rows, columns)) {
                draw(row, column);
            }
        }
    }
    add_covered(hits, covered, overlay.outlines);
}

} // namespace cli
