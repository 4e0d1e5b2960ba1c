#ifndef FILM_PARTS_GLSL
#define FILM_PARTS_GLSL

#include "film.glsl"

struct PartCount {
    uint accepted;
    uint done; // accepted or rejected
};

PartCount part_count(uint part, uint pixel_in_strip, uint strip_pixel_count)
{
    uint first = part * FILM_WORDS * strip_pixel_count + pixel_in_strip;
    uint accepted = film.words[first + FILM_ACCEPTED * strip_pixel_count];
    return PartCount(accepted, accepted + film.words[first + FILM_REJECTED * strip_pixel_count]);
}

uvec4 part_sum(uint part, uint channel, uint pixel_in_strip, uint strip_pixel_count)
{
    uint first = (part * FILM_WORDS + channel * FILM_SUM_WORDS) * strip_pixel_count + pixel_in_strip;
    return uvec4(film.words[first], film.words[first + strip_pixel_count], film.words[first + 2u * strip_pixel_count],
                 film.words[first + 3u * strip_pixel_count]);
}

uint film_covered(uint pixel_in_strip, uint strip_pixel_count)
{
    return film.words[FILM_COVERED * strip_pixel_count + pixel_in_strip];
}

#endif
