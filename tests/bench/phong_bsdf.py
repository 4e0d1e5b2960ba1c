"""The material of pt as a BSDF of Mitsuba 3: f = diffuse / pi + specular (n + 2) / (2 pi) max(0, w_o . r)^n, with the
mirror image r of w_i and the glossiness n (Phong 1975; Lafortune and Willems 1994). Mitsuba's variant must be set before
this module is imported. register() adds the plugin "pt_phong".
"""

import drjit as dr
import mitsuba as mi


class Phong(mi.BSDF):
    """Has one side. Parameters: diffuse and specular (rgb), glossiness (float)."""

    def __init__(self, props):
        super().__init__(props)
        diffuse, specular = list(props["diffuse"]), list(props["specular"])
        self.diffuse = mi.Color3f(diffuse)
        self.specular = mi.Color3f(specular)
        self.glossiness = props["glossiness"]
        self.specular_chance = sum(specular) / (sum(diffuse) + sum(specular))
        self.m_components = [mi.BSDFFlags.DiffuseReflection | mi.BSDFFlags.FrontSide,
                             mi.BSDFFlags.GlossyReflection | mi.BSDFFlags.FrontSide]
        self.m_flags = self.m_components[0] | self.m_components[1]

    def lobe(self, wi, wo):
        cosine = dr.maximum(dr.dot(wo, mi.Vector3f(-wi.x, -wi.y, wi.z)), 0)
        return dr.power(cosine, self.glossiness)

    def value_and_density(self, si, wo):
        front = (si.wi.z > 0) & (wo.z > 0)
        lobe = self.lobe(si.wi, wo)
        f = (self.diffuse * dr.inv_pi
             + self.specular * (lobe * ((self.glossiness + 2) * 0.5 * dr.inv_pi)))
        density = dr.lerp(mi.warp.square_to_cosine_hemisphere_pdf(wo),
                          lobe * ((self.glossiness + 1) * 0.5 * dr.inv_pi), self.specular_chance)
        return dr.select(front, f * wo.z, 0), dr.select(front, density, 0)

    def eval_pdf(self, ctx, si, wo, active=True):
        return self.value_and_density(si, wo)

    def eval(self, ctx, si, wo, active=True):
        return self.value_and_density(si, wo)[0]

    def pdf(self, ctx, si, wo, active=True):
        return self.value_and_density(si, wo)[1]

    def sample(self, ctx, si, sample1, sample2, active=True):
        cosine = dr.power(sample2.x, 1 / (self.glossiness + 1))
        sine = dr.safe_sqrt(1 - cosine * cosine)
        sin_phi, cos_phi = dr.sincos(dr.two_pi * sample2.y)
        mirrored = mi.Frame3f(mi.Vector3f(-si.wi.x, -si.wi.y, si.wi.z))
        glossy = mirrored.to_world(mi.Vector3f(sine * cos_phi, sine * sin_phi, cosine))
        is_glossy = sample1 < self.specular_chance
        bs = mi.BSDFSample3f()
        bs.wo = dr.select(is_glossy, glossy, mi.warp.square_to_cosine_hemisphere(sample2))
        bs.eta = 1
        bs.sampled_type = dr.select(is_glossy, +mi.BSDFFlags.GlossyReflection, +mi.BSDFFlags.DiffuseReflection)
        bs.sampled_component = dr.select(is_glossy, mi.UInt32(1), mi.UInt32(0))
        value, bs.pdf = self.value_and_density(si, bs.wo)
        valid = active & (bs.pdf > 0)
        return bs, dr.select(valid, value / bs.pdf, 0)

    def to_string(self):
        return f"Phong[{self.glossiness}]"


def register():
    mi.register_bsdf("pt_phong", Phong)
