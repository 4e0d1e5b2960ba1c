#include "lib/scene/view_sizes.h"
#include "lib/scene_file/json_items.h"
#include "lib/scene_file/names.h"
#include "lib/scene_file/scene_keys.h"
#include "lib/scene_file/text.h"

#include <algorithm>
#include <cstdint>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

namespace pt {
namespace {

using nlohmann::json;

void refuse_unknown_section(const JsonPlace &place) {
    if (place.key == "particles" || place.key == "figure") {
        refuse(place,
               "is no longer read: `pt figure DATA --write-scene SCENE` writes a scene whose spheres have columns, "
               "{\"center\": \"a.npy\", ...}");
    }
    std::vector<std::string_view> known;
    for (const SceneSection &section : scene_sections())
        known.push_back(section.name);
    known.emplace_back("animation");
    refuse_unknown_key(*place.parent, place.key, known);
}

void check_projection(const pt_camera &camera, const JsonPlace &place) {
    const ViewSize &own = view_sizes[camera.projection];
    for (const ViewSize &size : view_sizes)
        if (size.value != own.value && camera.*size.value != 0.0)
            refuse(place, concat('"', size.member, "\" is for ", size.article, ' ', size.projection, " projection, ",
                                 own.article, ' ', own.projection, " one has a \"", own.member, '"'));
    if (own.initial == 0.0 && camera.*own.value == 0.0)
        refuse(place,
               concat('"', own.member, "\" is missing, the height of ", own.article, ' ', own.projection, " view"));
}

class SceneReader : public JsonItemHandler {
public:
    // `scene` must already have its overrides.
    explicit SceneReader(SceneFile &scene) : scene_(scene) {}

    // Functions also throw JsonRefusal.
    void begin_section(const JsonPlace &place, json::value_t kind) override {
        section_ = find_section(place.key);
        if (section_ == nullptr && place.key != "animation")
            refuse_unknown_section(place);
        const bool is_array = section_ != nullptr && section_->form == SectionForm::array;
        const json::value_t wanted = is_array ? json::value_t::array : json::value_t::object;
        if (kind != wanted)
            refuse(place, "must be " + json_kind(wanted) + ", is " + json_kind(kind));
        begun_.insert(section_);
    }

    // Must be fast for items without an override, because there may be millions.
    void item(const JsonPlace &place, const json &value) override {
        const std::vector<std::size_t> changes =
            scene_.overrides.empty() ? std::vector<std::size_t>() : overrides_of(place.path());
        if (changes.empty())
            read(place, value);
        else
            read_changed(place, value, changes);
    }

    // Adds values that only overrides have, and checks the whole file. Resolves names of materials, which may follow
    // spheres in the file.
    void finish() {
        add_items_of_overrides();
        require_members();
        resolve_materials();
    }

private:
    std::vector<std::size_t> overrides_of(const JsonPath &item) const {
        std::vector<std::size_t> chosen;
        for (std::size_t i = 0; i < scene_.overrides.size(); ++i)
            if (is_within(scene_.overrides[i].path, item))
                chosen.push_back(i);
        return chosen;
    }

    // The file's value must be valid even if it is overridden.
    void read_changed(const JsonPlace &place, json value, const std::vector<std::size_t> &changes) {
        if (!value.is_null())
            check_item(place, value);
        for (const std::size_t index : changes) {
            scene_.overrides[index].apply_to(value);
            used_overrides_.insert(index);
        }
        try {
            read(place, value);
        } catch (const JsonRefusal &refusal) {
            for (const std::size_t index : changes) {
                const SceneOverride &cause = scene_.overrides[index];
                if (is_within(refusal.path, cause.path) || is_within(cause.path, refusal.path))
                    throw Error(cause.blame, cause.name_of(refusal.path) + ": " + refusal.what());
            }
            throw;
        }
    }

    void read(const JsonPlace &place, const json &value) {
        check_item(place, value);
        if (section_ == nullptr)
            scene_.animation.push_back(read_animated_value(place, value));
        else if (section_->form == SectionForm::members)
            read_member(place, value);
        else
            read_element(place, value);
    }

    // Does not check for missing members.
    void check_item(const JsonPlace &place, const json &value) const {
        if (section_ == nullptr)
            read_animated_value(place, value);
        else if (section_->form == SectionForm::members)
            check(key_of(*place.parent, place.key).rule, value, place);
        else
            check_element(place, value);
    }

    const SceneKey &key_of(const JsonPlace &object, std::string_view name) const {
        const SceneKey *key = find_key(*section_, name);
        if (key == nullptr)
            refuse_unknown_key(object, name, key_names(*section_));
        return *key;
    }

    bool is_many(const json &element) const {
        return section_->may_be_many() && element.contains("center") && element["center"].is_string();
    }

    void check_element(const JsonPlace &place, const json &value) const {
        if (!value.is_object())
            refuse(place, "must be an object, is " + shown(value));
        for (const auto &member : value.items()) {
            const SceneKey &key = key_of(place, member.key());
            if (key.column == nullptr || !member.value().is_string() || !is_many(value))
                check(key.rule, member.value(), place.member(key.name));
        }
    }

    void read_member(const JsonPlace &place, const json &value) {
        SceneItem item{scene_};
        key_of(*place.parent, place.key).store(item, value);
        scene_.given.push_back(place.path());
    }

    void read_element(const JsonPlace &place, const json &value) {
        SceneItem item{scene_};
        const bool has_columns = is_many(value);
        SphereColumns columns{section_->name, place.index};
        for (const SceneKey &key : section_->keys) {
            const auto found = value.find(key.name);
            if (found == value.end() && key.is_required)
                refuse(place, concat('"', key.name, "\" is missing"));
            if (found == value.end())
                continue;
            if (has_columns && key.column != nullptr && found->is_string()) {
                columns.add_file(key, found->get_ref<const std::string &>(), place.member(key.name));
                continue;
            }
            key.store(item, *found);
            if (has_columns && key.column != nullptr)
                columns.add_value(key, *found);
            else if (key.column != nullptr)
                single_items().note(key.column);
        }
        if (has_columns) {
            columns.material = number_of_material(item.material_name, place.member("material"));
            scene_.sphere_columns.push_back(std::move(columns));
        } else {
            add(item, place);
        }
    }

    void add(SceneItem &item, const JsonPlace &place) {
        if (section_->name == "materials") {
            scene_.materials.push_back(item.material);
            scene_.material_names.emplace_back(place.key);
            return;
        }
        const std::uint32_t material = number_of_material(item.material_name, place.member("material"));
        item.sphere.material = {material};
        item.plane.material = material;
        if (section_->may_be_many())
            single_items().items.push_back(item.sphere);
        else
            scene_.planes.push_back(item.plane);
    }

    SphereItems &single_items() { return section_->name == "spheres" ? scene_.sphere_items : scene_.capsules; }

    std::uint32_t number_of_material(const std::string &name, const JsonPlace &place) {
        const auto [entry, fresh] =
            material_numbers_.try_emplace(name, static_cast<std::uint32_t>(used_materials_.size()));
        if (fresh)
            used_materials_.push_back({name, place.path()});
        return entry->second;
    }

    void resolve_materials() {
        std::unordered_map<std::string_view, std::uint32_t> defined;
        for (const std::string &name : scene_.material_names)
            defined.emplace(name, static_cast<std::uint32_t>(defined.size()));
        std::vector<std::uint32_t> indices;
        for (const UsedName &used : used_materials_) {
            const auto found = defined.find(used.name);
            if (found == defined.end()) {
                const std::vector<std::string_view> known(scene_.material_names.begin(), scene_.material_names.end());
                throw JsonRefusal(used.first_place, unknown_name("material", used.name, known));
            }
            indices.push_back(found->second);
        }
        scene_.used_materials = indices;
        std::ranges::sort(scene_.used_materials);
        for (SphereItems *single : {&scene_.sphere_items, &scene_.capsules})
            for (SphereItem &item : single->items)
                item.material = {indices[item.material[0]]};
        if (scene_.spheres = scene_.sphere_items.structs(); !scene_.spheres.empty())
            scene_.sphere_items.items.clear();
        for (SphereColumns &each : scene_.sphere_columns)
            each.material = indices[each.material];
        for (pt_plane &plane : scene_.planes)
            plane.material = indices[plane.material];
    }

    void add_items_of_overrides() {
        for (std::size_t i = 0; i < scene_.overrides.size(); ++i) {
            if (used_overrides_.contains(i))
                continue;
            const SceneOverride &first = scene_.overrides[i];
            const JsonPath item(first.path.begin(), first.path.begin() + item_depth);
            if (item[0].in_array || item[1].in_array)
                throw Error(first.blame, first.source + ": the scene has no " + path_text(item));
            const JsonPlace root;
            const JsonPlace section = root.member(item[0].key);
            try {
                begin_section(section, json::value_t::object);
            } catch (const JsonRefusal &refusal) {
                throw Error(first.blame, first.source + ": " + refusal.what());
            }
            read_changed(section.member(item[1].key), nullptr, overrides_of(item));
        }
    }

    void require_members() const {
        const JsonPlace root;
        for (const SceneSection *section : begun_) {
            if (section == nullptr || section->form != SectionForm::members)
                continue;
            const JsonPlace place = root.member(section->name);
            for (const SceneKey &key : section->keys)
                if (key.is_required && !scene_.gives(place.member(key.name).path()))
                    refuse(place, concat('"', key.name, "\" is missing"));
        }
        check_projection(scene_.camera, root.member("camera"));
    }

    SceneFile &scene_;
    const SceneSection *section_ = nullptr; // nullptr in `animation`
    std::set<const SceneSection *> begun_;
    std::set<std::size_t> used_overrides_;

    struct UsedName {
        std::string name;
        JsonPath first_place;
    };
    std::vector<UsedName> used_materials_;
    std::unordered_map<std::string, std::uint32_t> material_numbers_;
};

} // namespace

void read_sections(SceneFile &scene, std::string_view text) {
    SceneReader reader(scene);
    parse_json_items(text, scene.path, reader);
    reader.finish();
}

} // namespace pt
