// Items of a probe (host: tests/accuracy/evaluation.h).
#ifndef ITEMS_GLSL
#define ITEMS_GLSL

layout(local_size_x = WORKGROUP_SIZE) in;
layout(push_constant) uniform ItemRange { uint count; uint skipped; } item_range;

bool is_item(uint index)
{
    return index < item_range.count && index != item_range.skipped;
}

#endif
