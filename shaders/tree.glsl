#ifndef TREE_GLSL
#define TREE_GLSL

#extension GL_EXT_samplerless_texture_functions : require

layout(set = 0, binding = BINDING_TREE_NODES) uniform utextureBuffer tree_nodes;
layout(set = 0, binding = BINDING_TREE_SPHERES) uniform utextureBuffer tree_spheres;

uvec4 tree_node_word(uint index) { return texelFetch(tree_nodes, int(index)); }
uvec4 tree_word(uint index) { return texelFetch(tree_spheres, int(index)); }

layout(set = 0, binding = BINDING_SCENE_STORAGE) readonly buffer SceneBits { uvec4 words[]; } scene_bits;

ivec3 tree_camera() { return ivec3(scene_bits.words[TREE_FRAME].xyz); }
vec3 tree_shift() { return scene_storage.words[TREE_FRAME + 1u].xyz; }
float tree_step() { return scene_storage.words[TREE_FRAME + 1u].w; }
vec3 tree_middle() { return scene_storage.words[TREE_FRAME + 2u].xyz; }
float tree_shutter_open() { return scene_storage.words[TREE_FRAME + 2u].w; }
uint tree_first_motion() { return scene_bits.words[TREE_FRAME + 3u].x; }
uint tree_first_surface() { return scene_bits.words[TREE_FRAME + 3u].y; }
uint tree_first_color() { return scene_bits.words[TREE_FRAME + 3u].z; }
uint tree_first_lamp() { return scene_bits.words[TREE_FRAME + 3u].w; }
float tree_shutter_time() { return scene_storage.words[TREE_FRAME + 4u].x; }

uvec4 tree_sphere_word(uint place) { return tree_word(place); }

// The ball relative to the point `base` + `rest` on the grid.
Ball tree_ball_from(uvec4 word, ivec3 base, vec3 rest, uint place, float time)
{
    vec3 center = (vec3(ivec3(word.xyz) - base) - rest) * tree_step();
    vec4 way = vec4(0.0);
    if (MOTION == 1 || TREE_KINDS > KIND_BALL)
        way = uintBitsToFloat(tree_word(tree_first_motion() + place));
    return ball_from(vec4(center, uintBitsToFloat(word.w)), way, tree_shutter_open() + time * tree_shutter_time(),
                     TREE_KINDS);
}

Ball tree_ball(uint place, float time)
{
    return tree_ball_from(tree_sphere_word(place), tree_camera(), -tree_shift() / tree_step(), place, time);
}

uint tree_surface(uint place)
{
    return tree_word(tree_first_surface() + place / 4u)[place % 4u];
}

// Returns the lamp's number in the tree. For other spheres it is TREE_LAMPS or greater.
uint tree_lamp(uint place)
{
    uint word = tree_surface(place);
    return (word & TREE_LAMP_BIT) != 0u ? word - TREE_LAMP_BIT : NO_SURFACE;
}

uint tree_lamp_place(uint lamp) { return tree_word(tree_first_lamp() + lamp).x; }

uint tree_material(uint place)
{
    uint word = tree_surface(place);
    bool is_lamp = TREE_LAMPS > 0u && (word & TREE_LAMP_BIT) != 0u;
    return is_lamp ? tree_word(tree_first_lamp() + (word - TREE_LAMP_BIT)).y : word;
}

vec3 tree_color(uint place)
{
    uint word = tree_word(tree_first_color() + place / 4u)[place % 4u];
    vec3 root = vec3(uvec3(word, word >> 10, word >> 20) & TREE_COLOR_STEPS) / float(TREE_COLOR_STEPS);
    return root * root;
}

#endif
