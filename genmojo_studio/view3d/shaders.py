"""GLSL 3.30 of the splat renderer. Semantics: genmojo_core/render/rasterizer.py; axes OpenCV, pixels raster.

Three passes: PROJECT computes every splat once, in drawing order, into three texels (a "work buffer"); SPLAT draws
one quad per splat from those texels, blended back to front with premultiplied alpha; RESOLVE turns the sums into
colours on the screen.
"""

from __future__ import annotations

HEADER = """#version 330 core
#define TEXELS 1024
#define SHELL 0.22           // alpha at the surface of an ellipsoid
ivec2 texel(int i) { return ivec2(i % TEXELS, i / TEXELS); }
"""

WHOLE_TARGET = """#version 330 core
void main() {
    gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0);
}
"""

PROJECT = (
    HEADER
    + """
uniform usampler2D order;
uniform sampler2D places, turns, sizes, colours, objects, scalars, next_places;
uniform sampler2DArray layer_places, layer_turns, layer_sizes, layer_colours;
uniform ivec2 layers;        // the two frames' slots, x < 0: none
uniform float between;       // 0..1 of the way from the first to the second
uniform int count;
uniform int mode;            // what goes into `value`
uniform mat4 camera;         // world to camera
uniform mat4 next_camera;
uniform vec4 lens;           // fx, fy, cx, cy
uniform vec4 limits;         // lowest u, highest u, lowest v, highest v of the Jacobian
uniform vec3 range;          // near, far, dilation
uniform float splat_scale;
uniform float thinning;      // sigmas grow by this where fewer splats stand for all
uniform vec2 size;           // pixels

layout(location = 0) out vec4 place;   // centre x, y in pixels; first half axis x, y for one sigma
layout(location = 1) out vec4 shape;   // second half axis x, y; opacity; reach of the quad in sigmas
layout(location = 2) out vec4 value;   // three channels of the mode; z

mat3 turn(vec4 q) {
    q = normalize(q);
    float w = q.x, x = q.y, y = q.z, z = q.w;
    return mat3(1 - 2*(y*y + z*z), 2*(x*y + w*z), 2*(x*z - w*y),
                2*(x*y - w*z), 1 - 2*(x*x + z*z), 2*(y*z + w*x),
                2*(x*z + w*y), 2*(y*z - w*x), 1 - 2*(x*x + y*y));
}

void fetch(int id, out vec3 at, out vec4 q, out vec3 sigma, out vec3 rgb) {
    ivec2 p = texel(id);
    sigma = texelFetch(sizes, p, 0).xyz;
    if (layers.x < 0) {
        at = texelFetch(places, p, 0).xyz;
        q = texelFetch(turns, p, 0);
        rgb = texelFetch(colours, p, 0).rgb;
        return;
    }
    at = texelFetch(layer_places, ivec3(p, layers.x), 0).xyz;
    q = texelFetch(layer_turns, ivec3(p, layers.x), 0);
    rgb = texelFetch(layer_colours, ivec3(p, layers.x), 0).rgb;
    vec3 ratio = texelFetch(layer_sizes, ivec3(p, layers.x), 0).xyz;
    if (between > 0.0) {
        at = mix(at, texelFetch(layer_places, ivec3(p, layers.y), 0).xyz, between);
        vec4 q1 = texelFetch(layer_turns, ivec3(p, layers.y), 0);
        q = mix(q, dot(q, q1) < 0.0 ? -q1 : q1, between);
        rgb = mix(rgb, texelFetch(layer_colours, ivec3(p, layers.y), 0).rgb, between);
        vec3 ratio1 = texelFetch(layer_sizes, ivec3(p, layers.y), 0).xyz;
        ratio = exp(mix(log(max(ratio, 1e-6)), log(max(ratio1, 1e-6)), between));
    }
    sigma *= ratio;
}

vec3 mode_value(int id, int owner, vec3 rgb, vec3 c, mat3 axes, vec3 sigma, vec3 offset) {
    if (mode == 0) {
        vec4 tint = texelFetch(objects, ivec2(1, owner), 0);
        return mix(rgb, tint.rgb, tint.a);
    }
    if (mode == 1) return texelFetch(objects, ivec2(2, owner), 0).rgb;
    if (mode == 2) return vec3(c.z, 0.0, 0.0);
    if (mode == 3) {
        vec3 after = (next_camera * vec4(texelFetch(next_places, texel(id), 0).xyz + offset, 1.0)).xyz;
        vec2 now = c.xy / c.z * lens.xy + lens.zw;
        return vec3(after.xy / max(after.z, range.x) * lens.xy + lens.zw - now, 0.0);
    }
    if (mode == 4) {
        vec3 n = sigma.x <= sigma.y && sigma.x <= sigma.z ? axes[0] : sigma.y <= sigma.z ? axes[1] : axes[2];
        return dot(n, c) > 0.0 ? -n : n;
    }
    if (mode == 5) return vec3(texelFetch(scalars, texel(id), 0).r, 0.0, 0.0);
    return vec3(owner == mode - 10, owner == mode - 9, owner == mode - 8);  // three objects' shares
}

void main() {
    int i = int(gl_FragCoord.y) * TEXELS + int(gl_FragCoord.x);
    place = vec4(0.0); shape = vec4(0.0); value = vec4(0.0);
    if (i >= count) return;
    int id = int(texelFetch(order, texel(i), 0).r);
    vec3 at, sigma, rgb; vec4 q;
    fetch(id, at, q, sigma, rgb);
    int owner = int(texelFetch(colours, texel(id), 0).a);
    vec4 object = texelFetch(objects, ivec2(0, owner), 0);  // offset, opacity gain
    vec3 c = (camera * vec4(at + object.xyz, 1.0)).xyz;
    float opacity = texelFetch(sizes, texel(id), 0).a * object.a;
    if (!(c.z >= range.x && c.z <= range.y && opacity * 255.0 >= 1.0)) return;
    mat3 axes = mat3(camera) * turn(q);
    sigma *= splat_scale * thinning;
    mat3 root = mat3(axes[0] * sigma.x, axes[1] * sigma.y, axes[2] * sigma.z);
    vec2 uv = clamp(c.xy / c.z, limits.xz, limits.yw);
    vec3 a = (lens.x / c.z) * (vec3(1, 0, -uv.x) * root);
    vec3 b = (lens.y / c.z) * (vec3(0, 1, -uv.y) * root);
    vec3 minors = cross(a, b);
    float d = range.z, xx = dot(a, a), xy = dot(a, b), yy = dot(b, b);
    float det = dot(minors, minors) + d * (xx + yy) + d * d;   // no cancellation: needles stay needles
    float most = 0.5 * (xx + yy) + d + length(vec2(0.5 * (xx - yy), xy));
    float angle = 0.5 * atan(2.0 * xy, xx - yy);
    vec2 axis = vec2(cos(angle), sin(angle));
    float reach = sqrt(2.0 * log(opacity * 255.0));
    float s0 = sqrt(most), s1 = sqrt(max(det / most, 0.0));
    vec2 centre = c.xy / c.z * lens.xy + lens.zw;
    vec2 extent = reach * sqrt(vec2(xx, yy) + d);
    if (any(greaterThan(centre - extent, size)) || any(lessThan(centre + extent, vec2(0)))) return;
    if (!(s0 * reach < 1e6 && s1 > 0.0)) return;   // also drops what is not finite
    place = vec4(centre, axis * s0);
    shape = vec4(vec2(-axis.y, axis.x) * s1, opacity, reach);
    value = vec4(mode_value(id, owner, rgb, c, axes, sigma, object.xyz), c.z);
}
"""
)

SPLAT_VERTEX = (
    HEADER
    + """
uniform sampler2D place, shape, value;
uniform vec2 size;
uniform int style;           // 0 soft splats, 1 ellipsoids, 2 centres, 3 log of what passes, by depth
uniform float dot_size;      // pixels
flat out vec4 channels;      // three channels, opacity
flat out float depth;
flat out float edge;         // reach in sigmas
out vec2 q;                  // in sigmas

void main() {
    ivec2 p = texel(gl_InstanceID);
    vec4 s = texelFetch(shape, p, 0);
    if (s.z <= 0.0) { gl_Position = vec4(2.0, 2.0, 0.0, 1.0); return; }
    vec4 c = texelFetch(place, p, 0);
    vec4 v = texelFetch(value, p, 0);
    vec2 corner = vec2((gl_VertexID & 1) * 2 - 1, (gl_VertexID & 2) - 1);
    float reach = s.w;
    if (style == 1) reach = sqrt(max(2.0 * log(s.z / SHELL), 0.0));
    if (style == 2) reach = 1.0;
    vec2 along = style == 2 ? vec2(dot_size, 0) : c.zw, across = style == 2 ? vec2(0, dot_size) : s.xy;
    q = corner * reach;
    vec2 at = c.xy + q.x * along + q.y * across;
    gl_Position = vec4(2.0 * at.x / size.x - 1.0, 1.0 - 2.0 * at.y / size.y, 0.0, 1.0);
    channels = vec4(v.xyz, s.z);
    depth = v.w;
    edge = reach;
}
"""
)

SPLAT_FRAGMENT = """#version 330 core
uniform int style;
uniform sampler2D bracket;   // style 3: lowest and highest depth of every pixel's search
flat in vec4 channels;
flat in float depth;
flat in float edge;
in vec2 q;
layout(location = 0) out vec4 sum;

void main() {
    float r2 = dot(q, q);
    if (style == 1) {
        if (r2 > edge * edge) discard;
        sum = vec4(channels.rgb * (0.35 + 0.65 * sqrt(1.0 - r2 / (edge * edge))), 1.0);
        return;
    }
    if (style == 2) {
        if (r2 > 1.0) discard;
        sum = vec4(channels.rgb, 1.0);
        return;
    }
    float alpha = min(0.99, channels.a * exp(-0.5 * r2));
    if (alpha < 1.0 / 255.0) discard;
    if (style == 3) {
        vec2 b = texelFetch(bracket, ivec2(gl_FragCoord.xy), 0).xy;
        vec4 steps = b.x + (b.y - b.x) * vec4(0.2, 0.4, 0.6, 0.8);
        sum = -log(1.0 - alpha) * vec4(lessThan(vec4(depth), steps));
        return;
    }
    sum = vec4(channels.rgb * alpha, alpha);
}
"""

# Median depth: narrow [lowest, highest] to the fifth of it where transmittance falls under one half.
NARROW = """#version 330 core
uniform sampler2D absorbed, bracket;
out vec4 found;
void main() {
    ivec2 p = ivec2(gl_FragCoord.xy);
    vec4 t = texelFetch(absorbed, p, 0);
    vec2 b = texelFetch(bracket, p, 0).xy;
    float n = dot(vec4(lessThan(t, vec4(0.69314718))), vec4(1.0));   // ln 2
    float width = (b.y - b.x) * 0.2;
    found = vec4(b.x + n * width, b.x + (n + 1.0) * width, 0.0, 1.0);
}
"""

MEDIAN = """#version 330 core
uniform sampler2D bracket;
uniform float none_from;     // a search that ended here found no such depth
out vec4 found;
void main() {
    vec2 b = texelFetch(bracket, ivec2(gl_FragCoord.xy), 0).xy;
    found = b.y > none_from ? vec4(0.0) : vec4(0.5 * (b.x + b.y), 0.0, 0.0, 1.0);
}
"""

# Objects: keep the three-share pass's best where it beats the best so far.
KEEP_BEST = """#version 330 core
uniform sampler2D shares, best;
uniform int first;
out vec4 found;                       // position of the object, its share, 0, coverage
void main() {
    ivec2 p = ivec2(gl_FragCoord.xy);
    vec4 s = texelFetch(shares, p, 0);
    found = first == 0 ? vec4(0.0) : texelFetch(best, p, 0);
    for (int k = 0; k < 3; k++) if (s[k] > found.y) found.xy = vec2(first + k, s[k]);
    found.w = s.a;
}
"""

RESOLVE = """#version 330 core
uniform sampler2D sums, palette, objects;
uniform int show;            // 0 colour, 1 scale of one value, 2 flow wheel, 3 normals, 4 objects, 5 coverage
uniform vec4 backdrop;       // RGB and 1, or 0 for a transparent picture
uniform vec2 bounds;         // of the colour scale
uniform vec2 target_size;
out vec4 colour;

vec3 wheel(vec2 flow) {
    float turn = atan(flow.y, flow.x) / 6.28318531 + 0.5;
    vec3 hue = clamp(abs(fract(turn + vec3(0.0, 2.0 / 3.0, 1.0 / 3.0)) * 6.0 - 3.0) - 1.0, 0.0, 1.0);
    return mix(vec3(1.0), hue, clamp(length(flow) / max(bounds.y, 1e-9), 0.0, 1.0));
}

vec3 on_scale(float share) {
    return texture(palette, vec2((clamp(share, 0.0, 1.0) * 255.0 + 0.5) / 256.0, 0.5)).rgb;
}

void main() {
    vec2 at = gl_FragCoord.xy / target_size;
    vec4 s = texture(sums, at);
    vec3 mean = s.rgb / max(s.a, 1e-4);
    vec3 rgb = s.rgb;
    float a = s.a;
    if (show == 1) rgb = on_scale((mean.x - bounds.x) / max(bounds.y - bounds.x, 1e-9)) * a;
    if (show == 2) rgb = wheel(mean.xy) * a;
    if (show == 3) rgb = (0.5 + 0.5 * vec3(mean.x, -mean.y, -mean.z) / max(length(mean), 1e-6)) * a;
    if (show == 4) {
        s = texelFetch(sums, ivec2(at * vec2(textureSize(sums, 0))), 0);
        a = s.a > 0.5 ? 1.0 : 0.0;
        rgb = texelFetch(objects, ivec2(2, int(s.x)), 0).rgb * a;
    }
    if (show == 5) { rgb = on_scale(a); a = 1.0; }
    colour = backdrop.a > 0.5 ? vec4(rgb + (1.0 - a) * backdrop.rgb, 1.0) : vec4(rgb, a);
}
"""
