// Garments that come as meshes: what becomes of them, and what is refused with which words.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <random>
#include <set>

#include "avatar/gltf_document.h"
#include "body/mesh.h"
#include "cook/cook_file.h"
#include "cook/garment_writer.h"
#include "cook/model/alignment.h"
#include "cook/model/gltf.h"
#include "cook/model/obj.h"
#include "cook/model/surface.h"
#include "core/error.h"
#include "core/files.h"
#include "mesh_files.h"
#include "pattern_support.h"

namespace vfit {
namespace {

class MeshGarment : public testing::Test {
protected:
    static void SetUpTestSuite() {
        model = BodyModel::load(VFIT_DATA_DIR "/body.bin");
        fabrics = FabricLibrary::parse(read_file(VFIT_SOURCE_DIR "/assets/fabrics.json"));
        jobs = Jobs::own(1);
    }
    void SetUp() override {
        folder =
            std::filesystem::temp_directory_path() / ("vfit_mesh_" + std::to_string(std::random_device()()));
        std::filesystem::create_directories(folder / "own");
    }
    void TearDown() override { std::filesystem::remove_all(folder); }

    std::string write(const std::string& name, const std::string& bytes) const {
        const std::filesystem::path path = folder / "own" / name;
        std::ofstream(path, std::ios::binary) << bytes;
        return path.string();
    }
    static CookRequest request_of(const std::string& path, vfit_sex sex = VFIT_SEX_FEMALE) {
        CookRequest request;
        request.path = path;
        request.sex = sex;
        request.size_label = "M";
        return request;
    }
    CookedGarment cook(const std::string& name, const std::string& bytes,
                       vfit_sex sex = VFIT_SEX_FEMALE) const {
        return std::move(cook_file(*model, fabrics, request_of(write(name, bytes), sex), *jobs).front());
    }

    static void expect_not_cooked(const CookRequest& request, std::initializer_list<const char*> words) {
        try {
            cook_file(*model, fabrics, request, *jobs);
            ADD_FAILURE() << "accepted: " << *words.begin();
        } catch (const Error& error) {
            for (const char* word : words)
                EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
        }
    }

    std::filesystem::path folder;
    static inline std::shared_ptr<const BodyModel> model;
    static inline FabricLibrary fabrics;
    static inline std::unique_ptr<Jobs> jobs;
};

bool has_note(const std::vector<std::string>& notes, const std::string& words) {
    return std::any_of(notes.begin(), notes.end(),
                       [&](const std::string& note) { return note.find(words) != std::string::npos; });
}

/// Of all sides, by length.
std::vector<float> side_lengths(const std::vector<Vec3>& positions, const std::vector<uint32_t>& indices) {
    std::vector<float> out;
    for (size_t i = 0; i < indices.size(); ++i)
        out.push_back(glm::length(positions[indices[i]] - positions[indices[i - i % 3 + (i + 1) % 3]]));
    std::sort(out.begin(), out.end());
    return out;
}

TEST_F(MeshGarment, ATubeBecomesASkirtOnTheWaist) {
    const TubeMesh tube;
    write("skirt.mtl",
          "newmtl red wool\nKd 0.5 0.1 0.05\nmap_Kd -s 2 2 -bm 0.5 wool pictures/red wool.png\nnewmtl "
          "unused\nmap_Kd gone.png\n");
    const CookedGarment cooked =
        cook("skirt.obj", "# made by hand\r\nmtllib skirt.mtl\no skirt\nusemtl red wool\n" + obj_of(tube));
    const Garment& g = cooked.garment;
    EXPECT_EQ(g.name, "skirt");
    EXPECT_EQ(cooked.report.hangs_on, HangsOn::waist);
    EXPECT_EQ(cooked.report.skin_crossings, 0u);
    EXPECT_EQ(cooked.report.self_crossings, 0u);
    EXPECT_LT(cooked.report.strain_p99, 0.1f);
    EXPECT_EQ(g.vertex_count(), 36u * 21);  // the seam of the picture is none of the cloth
    EXPECT_EQ(g.copies.size(), 21u);
    EXPECT_EQ(g.vertex_count() - g.simulated_count(), 36u);  // the band
    EXPECT_EQ(cooked.openings_m.size(), 2u);
    ASSERT_EQ(g.parts.size(), 1u);
    EXPECT_EQ(g.parts[0].material, "red wool");
    EXPECT_EQ(g.parts[0].texture, "wool pictures/red wool.png");
    EXPECT_LT(glm::length(g.parts[0].color - Vec3(0.5f, 0.1f, 0.05f)), 1e-6f);
    EXPECT_TRUE(
        has_note(cooked.notes, "\"wool pictures/red wool.png\" of material \"red wool\" is not there"));
    EXPECT_FALSE(has_note(cooked.notes, "gone.png"));  // of a material that nothing is made of
    // The uvs of both ends of the picture are there.
    for (const Vec2& uv : tube.uvs())
        EXPECT_TRUE(std::any_of(g.mesh.uvs.begin(), g.mesh.uvs.end(),
                                [&](const Vec2& own) { return glm::length(own - uv) < 1e-5f; }));
    // Outside out, in its own lengths.
    size_t out = 0;
    for (size_t i = 0; i < g.mesh.positions.size(); ++i)
        out += glm::dot(g.mesh.normals[i], Vec3(g.mesh.positions[i].x, 0, g.mesh.positions[i].z)) > 0.0f;
    EXPECT_GT(out, g.mesh.positions.size() * 9 / 10);
    const Garment read = parse_garment(bytes_of_text(write_garment(g)), fabrics);
    const std::vector<float> shape = side_lengths(read.cut_shape, read.mesh.indices),
                             rest = side_lengths(read.mesh.positions, read.mesh.indices);
    double ratio = 0.0;
    for (size_t i = 0; i < shape.size(); ++i)
        ratio += double(rest[i]) / double(shape[i]) / double(shape.size());
    EXPECT_NEAR(ratio, 1.0, 0.03);
    ASSERT_EQ(read.sizes.size(), 1u);
    EXPECT_EQ(read.sizes[0].label, "M");
    EXPECT_EQ(read.corners, g.corners);
    EXPECT_TRUE(read.flat.empty());
}

TEST_F(MeshGarment, AShirtOfOursReadsBackInBothFormats) {
    const Garment shirt =
        cook_file(*model, fabrics, request_of(VFIT_SOURCE_DIR "/assets/garments/shirt_men.json"), *jobs)
            .front()
            .garment;
    std::vector<Vec3> drawn = shirt.mesh.positions;
    for (const uint32_t v : shirt.copies) drawn.push_back(shirt.mesh.positions[v]);
    const std::vector<float> lengths = side_lengths(shirt.mesh.positions, shirt.mesh.indices);
    const std::string obj = obj_vertices(drawn, shirt.mesh.uvs) + obj_faces(shirt.uv_indices(), 3);
    const std::string glb = TinyGlb(drawn, shirt.mesh.uvs, shirt.uv_indices()).bytes();
    for (const auto& [name, bytes] : {std::pair("shirt.obj", obj), std::pair("shirt.glb", glb)}) {
        const CookedGarment cooked = cook(name, bytes, VFIT_SEX_MALE);
        const Garment& g = cooked.garment;
        EXPECT_EQ(g.vertex_count(), shirt.vertex_count()) << name;
        EXPECT_EQ(cooked.report.hangs_on, HangsOn::shoulders) << name;
        EXPECT_LT(std::abs(cooked.report.raised_m), 0.01f) << name;
        EXPECT_EQ(cooked.report.skin_crossings, 0u) << name;
        EXPECT_EQ(cooked.report.self_crossings, 0u) << name;
        EXPECT_GT(g.vertex_count() - g.simulated_count(), 10u) << name;
        EXPECT_EQ(cooked.openings_m.size(), 4u) << name;
        const std::vector<float> own = side_lengths(g.cut_shape, g.mesh.indices);
        ASSERT_EQ(own.size(), lengths.size());
        for (size_t i = 0; i < own.size(); ++i) ASSERT_NEAR(own[i], lengths[i], 1e-4f) << name;
        // Its sleeves are those of the pattern, but for the seam around the armhole.
        const auto count = [](const Garment& of) {
            return std::count(of.on_arm.begin(), of.on_arm.end(), 1);
        };
        EXPECT_NEAR(double(count(g)), double(count(shirt)), 0.2 * double(count(shirt))) << name;
        EXPECT_TRUE(cooked.notes.empty()) << cooked.notes[0];
        if (std::string(name) == "shirt.glb") {
            ASSERT_EQ(g.parts.size(), 1u);
            EXPECT_EQ(g.parts[0].material, "linen");
            EXPECT_LT(glm::length(g.parts[0].color - Vec3(0.1f, 0.2f, 0.3f)), 1e-6f);
        }
    }
}

TEST_F(MeshGarment, ComesToItsPlaceFromAnotherBodys) {
    TubeMesh low;
    low.top_m -= 0.3f, low.bottom_m -= 0.3f;
    const CookedGarment as_it_is = cook("a.obj", obj_of(TubeMesh())), raised = cook("b.obj", obj_of(low));
    EXPECT_NEAR(raised.report.raised_m - as_it_is.report.raised_m, 0.25f, 0.1f);
    EXPECT_EQ(raised.report.skin_crossings, 0u);
    // The men's waistcoat that was a women's: what lay within comes out.
    const Garment vest =
        cook_file(*model, fabrics, request_of(VFIT_SOURCE_DIR "/assets/garments/vest.json"), *jobs)
            .front()
            .garment;
    std::vector<Vec3> forward = vest.mesh.positions;
    for (Vec3& p : forward) p.z += 0.1f;
    const CookedGarment mens =
        cook("vest.obj",
             obj_vertices(forward, std::vector<Vec2>(forward.size())) + obj_faces(vest.mesh.indices, 3),
             VFIT_SEX_MALE);
    EXPECT_EQ(mens.report.hangs_on, HangsOn::shoulders);
    EXPECT_GT(mens.report.raised_m, 0.05f);
    EXPECT_EQ(mens.report.skin_crossings, 0u);
    EXPECT_EQ(mens.report.self_crossings, 0u);
    EXPECT_TRUE(has_note(mens.notes, "cm too far forward"));
    EXPECT_TRUE(has_note(mens.notes, "of the vertices lay in the body"));
}

TEST_F(MeshGarment, SmallTrianglesAreDrawnOnLargerOnes) {
    TubeMesh fine;
    fine.columns = 120, fine.rows = 60;
    const CookedGarment cooked = cook("fine.obj", obj_of(fine));
    const Garment& g = cooked.garment;
    EXPECT_EQ(cooked.report.self_crossings, 0u);
    EXPECT_EQ(cooked.report.skin_crossings, 0u);
    EXPECT_LT(cooked.report.strain_p99, 0.1f);
    EXPECT_TRUE(has_note(cooked.notes, "even triangles"));
    EXPECT_EQ(g.drawn.indices.size(), fine.triangles().size());
    EXPECT_LT(g.vertex_count(), 2500u);
    // It's drawn as it was modelled, at the body.
    std::vector<Vec3> normals, drawn;
    compute_normals(g.cut_shape, g.mesh.indices, normals);
    const CarryingMesh carrying{g.mesh.indices, g.cut_shape, normals};
    const std::vector<Vec3> modelled = fine.positions();
    ASSERT_EQ(g.drawn_count(), modelled.size());
    Vec3 moved(0.0f);
    for (uint32_t i = 0; i < g.drawn_count(); ++i) {
        const DrawnFrame frame(carrying, g.drawn.triangles[i], g.drawn.weights[i]);
        drawn.push_back(frame.origin + frame.axes * g.drawn.offsets[i]);
        moved += (drawn.back() - modelled[i]) / float(modelled.size());
        ASSERT_LT(glm::length(g.drawn.offsets[i]), 0.03f) << i;
    }
    for (const Vec3& at : drawn) {
        float least = INFINITY;
        for (const Vec3& p : modelled) least = std::min(least, glm::length(p + moved - at));
        ASSERT_LT(least, 2e-4f);
    }
    const Garment read = parse_garment(bytes_of_text(write_garment(g)), fabrics);
    EXPECT_EQ(read.drawn.indices, g.drawn.indices);
    EXPECT_EQ(read.drawn_count(), g.drawn.vertex_count());
    CookRequest request = request_of(write("fine.obj", obj_of(fine)));
    request.remake = Remake::never;
    EXPECT_TRUE(
        has_note(cook_file(*model, fabrics, request, *jobs).front().notes, "too small for its own layers"));
    TubeMesh coarse;
    coarse.columns = 12, coarse.rows = 5;
    EXPECT_TRUE(has_note(cook("coarse.obj", obj_of(coarse)).notes, "fold coarsely"));
    // Names in whatever bytes: a garment file is UTF-8 all the same.
    EXPECT_NO_THROW(parse_garment(
        bytes_of_text(write_garment(cook("caf.obj", "usemtl caf\xe9\n" + obj_of(coarse)).garment)), fabrics));
}

TEST_F(MeshGarment, CountsInTheUnitThatIsSaid) {
    TubeMesh tube;
    tube.unit = 100.0f;
    CookRequest request = request_of(write("cm.obj", obj_of(tube)));
    request.unit_m = 0.01f;
    const Garment g = cook_file(*model, fabrics, request, *jobs).front().garment;
    const std::vector<float> a = side_lengths(g.cut_shape, g.mesh.indices);
    EXPECT_NEAR(a.back(), side_lengths(TubeMesh().positions(), TubeMesh().triangles()).back(), 1e-4f);
}

Surface surface_of(const Model& model, float unit_m = 1.0f) {
    const Pieces pieces = make_pieces(make_soup(model, unit_m));
    Surface surface = make_surface(pieces, pieces.list.front(), 0.03f);
    surface.notes.insert(surface.notes.end(), pieces.notes.begin(), pieces.notes.end());
    return surface;
}
Surface surface_of(const std::string& obj, float unit_m = 1.0f) {
    return surface_of(read_obj(obj, Beside()), unit_m);
}

std::string refusal_of(const std::string& obj, float unit_m = 1.0f) {
    try {
        surface_of(obj, unit_m);
        return "";
    } catch (const Error& error) {
        EXPECT_TRUE(error.code() == VFIT_ERROR_DATA || error.code() == VFIT_ERROR_UNSUPPORTED);
        return error.what();
    }
}

void expect_refused(const std::string& obj, std::initializer_list<const char*> words, float unit_m = 1.0f) {
    const std::string said = refusal_of(obj, unit_m);
    EXPECT_FALSE(said.empty()) << "accepted: " << *words.begin();
    for (const char* word : words) EXPECT_NE(said.find(word), std::string::npos) << word << ": " << said;
}

TEST(ObjFile, NamesTheLineOfWhatCannotBeRead) {
    const std::string start = "v 0 1 0\nv 1 1 0\nv 0 0 0\nvt 0 0\n";
    expect_refused("", {"no vertex"});
    expect_refused("hello", {"no vertex"});
    expect_refused(start, {"no face"});
    expect_refused(std::string("v 0 0 0\0", 8), {"not text"});
    expect_refused(start + "f 1 2 4\n", {"line 5", "vertex 4 of 3"});
    expect_refused(start + "f 1 2 -4\n", {"line 5", "vertex -4 of 3"});
    expect_refused(start + "f 1 2 0\n", {"line 5", "vertex 0"});
    expect_refused(start + "f 1/1 2/1 3/2\n", {"line 5", "uv 2 of 1"});
    expect_refused(start + "f 1 2 99999999999999999999\n", {"line 5", "no index"});
    expect_refused(start + "f 1 2 x\n", {"line 5", "\"x\""});
    expect_refused(start + "\n# remark\nf 1 2\n", {"line 7", "2 corners"});
    expect_refused(start + "v 1 2\n", {"line 5", "2 numbers", "cut"});
    expect_refused("v nan 0 0\n", {"line 1", "nan"});
    expect_refused("v 1e39 0 0\n", {"line 1", "1e39"});
    expect_refused("v 1 2 inf\n", {"line 1"});
    expect_refused("v 1,5 2 3\n", {"line 1", "1,5"});
    expect_refused(start + "cstype bezier\n", {"line 5", "curved"});
    std::string wide = start + "f";
    for (int i = 0; i < 300; ++i) wide += " 1";
    expect_refused(wide, {"line 5", "256"});
    // As programs write them all the same.
    const Model model = read_obj(
        "v +1. 2e0 3 1 0.5 0.5 0.5\r\nv 0 1 \\\n 0 # remark\rv 0 0 0\nvn 0 0 1\nf -3//1 2//-1 3//1\nl 1 2\ns "
        "off\n",
        Beside());
    EXPECT_EQ(model.positions.size(), 3u);
    EXPECT_EQ(model.positions[0], Vec3(1, 2, 3));
    EXPECT_EQ(model.positions[1], Vec3(0, 1, 0));
    EXPECT_EQ(model.faces.size(), 1u);
    EXPECT_EQ(model.corners[0].position, 0u);
    EXPECT_EQ(model.faces[0].number, 6u);
}

TEST_F(MeshGarment, FindsTheUnitAndWhichWayIsUp) {
    const std::vector<float> metres = side_lengths(TubeMesh().positions(), TubeMesh().triangles());
    for (const auto& [unit, name] :
         {std::pair(100.0f, "centimetres"), std::pair(1000.0f, "millimetres"), std::pair(10.0f, "decimetres"),
          std::pair(1.0f / 0.0254f, "inches"), std::pair(1.0f / 0.3048f, "feet")}) {
        TubeMesh tube;
        tube.unit = unit;
        const CookedGarment cooked = cook(std::string(name) + ".obj", obj_of(tube));
        EXPECT_TRUE(has_note(cooked.notes, name)) << name;
        const std::vector<float> own = side_lengths(cooked.garment.cut_shape, cooked.garment.mesh.indices);
        EXPECT_NEAR(own.back(), metres.back(), 1e-4f) << name;
    }
    TubeMesh tube;
    std::vector<Vec3> lying = tube.positions();
    for (Vec3& p : lying) p = Vec3(p.x, -p.z, p.y) + Vec3(5.0f, -3.0f, 0.0f);
    const CookedGarment turned =
        cook("lying.obj", obj_vertices(lying, tube.uvs()) + obj_faces(tube.squares(), 4));
    EXPECT_TRUE(has_note(turned.notes, "Z up"));
    EXPECT_EQ(turned.report.hangs_on, HangsOn::waist);
    EXPECT_EQ(turned.report.skin_crossings, 0u);

    const auto refused = [&](float unit_m, float scale, std::initializer_list<const char*> words) {
        CookRequest request = request_of(write("tube.obj", obj_of(tube)));
        request.unit_m = unit_m, request.scale = scale;
        expect_not_cooked(request, words);
    };
    refused(0.01f, 0.0f, {"m large", "metres (--unit m)"});
    refused(1.0f, 0.2f, {"goes round nothing"});
    tube.unit = 1e6f;
    refused(0.0f, 0.0f, {"size can't be told", "--scale"});
    for (const char* vertex : {"v 1e6 0 0", "v 0 -4e18 0", "v 0 0 3e38"}) {
        tube.unit = 1.0f;
        const std::string stray = vfit::text(vertex, "\nf 1 2 ", tube.positions().size() + 1, "\n");
        expect_not_cooked(request_of(write("stray.obj", obj_of(tube) + stray)),
                          {"the face in line", "as far out"});
    }
    // Flat in any direction.
    std::string sheet;
    for (int i = 0; i < 121; ++i)
        sheet += vfit::text("v ", 0.1f * float(i % 11), " 1 ", 0.1f * float(i / 11), "\n");
    for (int i = 0; i < 109; ++i)
        if (i % 11 != 10) sheet += vfit::text("f ", i + 1, " ", i + 2, " ", i + 13, " ", i + 12, "\n");
    EXPECT_THROW(cook("sheet.obj", sheet), Error);
}

TEST(MeshSurface, RefusesWhatIsNoClothByName) {
    const TubeMesh tube;
    const std::string good = obj_of(tube);
    const auto next = [&](int i) { return std::to_string(tube.positions().size() + size_t(i)); };
    EXPECT_EQ(refusal_of(good), "");
    // A sliver, joined to the border.
    std::vector<Vec3> p = tube.positions();
    const Vec3 middle = 0.5f * (p[0] + p[1]);
    std::ostringstream on_line;
    on_line.precision(9);
    on_line << "v " << middle.x << ' ' << middle.y << ' ' << middle.z << '\n';
    expect_refused(good + on_line.str() + "f 2 1 " + next(1) + "\n", {"degenerate", "the face in line"});
    // A polygon that crosses itself, and one that is not flat.
    expect_refused(good + "v 0.3 1 0\nv 0.4 1.1 0\nv 0.4 1 0\nv 0.3 1.1 0\nv 0.5 1.05 0\nf " + next(1) + " " +
                       next(2) + " " + next(5) + " " + next(3) + " " + next(4) + "\n",
                   {"the face in line", "crosses itself"});
    expect_refused(good + "v 0.3 1 0\nv 0.4 1 0.1\nv 0.4 1.1 -0.1\nv 0.3 1.1 0.1\nv 0.2 1.05 -0.1\nf " +
                       next(1) + " " + next(2) + " " + next(3) + " " + next(4) + " " + next(5) + "\n",
                   {"the face in line", "not in a plane"});
    // Few and many.
    TubeMesh coarse;
    coarse.columns = 6, coarse.rows = 2;
    expect_refused(obj_of(coarse), {"24 triangles", "coarse"});
    TubeMesh fine;
    fine.columns = 800, fine.rows = 320;
    expect_refused(obj_of(fine), {"512000 triangles", "500000"});
    expect_refused(good + "v 0 4e18 0\nf 1 2 " + next(1) + "\n", {"km from the origin"});
}

/// The same tube again around it, or within it.
std::string shell(float apart_m, size_t first, bool inward) {
    TubeMesh other;
    other.radius_m += apart_m;
    std::vector<uint32_t> squares = other.squares();
    if (inward)
        for (size_t i = 0; i < squares.size(); i += 4) std::swap(squares[i + 1], squares[i + 3]);
    for (uint32_t& v : squares) v += uint32_t(first);
    return obj_vertices(other.positions(), other.uvs()) + obj_faces(squares, 4);
}

TEST_F(MeshGarment, ClothThatIsModelledWithThicknessIsDrawnSo) {
    const TubeMesh tube;
    const size_t n = tube.positions().size();
    const std::string two = obj_of(tube) + shell(-0.004f, n, true);
    const auto refused = [&](const std::string& obj, std::initializer_list<const char*> words) {
        CookRequest request = request_of(write("thick.obj", obj));
        request.remake = Remake::never;
        expect_not_cooked(request, words);
    };
    const auto drawn = [&](const std::string& obj, size_t triangles) {
        const CookedGarment cooked = cook("thick.obj", obj);
        EXPECT_TRUE(has_note(cooked.notes, "made anew"));
        EXPECT_EQ(cooked.report.crossings(), 0u);
        EXPECT_EQ(cooked.openings_m.size(), 2u);
        EXPECT_EQ(cooked.garment.drawn.indices.size(), 3 * triangles);
    };
    refused(two, {"thickness", "two shells", "4 mm", "outer shell"});
    drawn(two, 2 * tube.triangles().size() / 3);
    // Joined around both rims: closed.
    std::string rims;
    const int c = tube.columns, last = tube.rows * (c + 1);
    for (int i = 0; i < c; ++i) {
        rims += vfit::text("f ", i + 1, " ", i + 2, " ", int(n) + i + 2, " ", int(n) + i + 1, "\n");
        rims += vfit::text("f ", last + i + 2, " ", last + i + 1, " ", int(n) + last + i + 1, " ",
                           int(n) + last + i + 2, "\n");
    }
    drawn(two + rims, 2 * tube.triangles().size() / 3 + size_t(4 * c));
    // A sack, closed all around.
    std::string lids = "v 0 1.05 0\nv 0 0.6 0\n";
    for (int i = 0; i < c; ++i)
        lids += vfit::text("f ", i + 1, " ", i + 2, " ", n + 1, "\nf ", last + i + 2, " ", last + i + 1, " ",
                           n + 2, "\n");
    expect_refused(obj_of(tube) + lids, {"no opening", "closed all around"});
    const CookedGarment opened = cook("sack.obj", obj_of(tube) + lids);
    EXPECT_TRUE(has_note(opened.notes, "2 ends that were closed by cloth were cut open"));
    EXPECT_EQ(opened.openings_m.size(), 2u);
    // And one with a hole that is too small for a head.
    std::vector<uint32_t> squares = tube.squares();
    squares.resize(squares.size() - 4);
    expect_refused(obj_vertices(tube.positions(), tube.uvs()) + obj_faces(squares, 4) + lids,
                   {"no opening for a body", "cm around"});
}

TEST_F(MeshGarment, MendsWhatCanBe) {
    const TubeMesh tube;
    const std::string vertices = obj_vertices(tube.positions(), tube.uvs());
    // Every fifth square the wrong way round, one twice, a button, a hole of the size of a buttonhole, and a
    // square of no size.
    std::vector<uint32_t> squares = tube.squares();
    for (size_t i = 0; i < squares.size(); i += 20) std::swap(squares[i + 1], squares[i + 3]);
    squares.insert(squares.end(), squares.begin() + 4, squares.begin() + 8);
    std::string text = vertices + obj_faces(squares, 4) + "f 50 50 51\n";
    const size_t n = tube.positions().size();
    text += vfit::text("usemtl buttons\nv 0 0.9 0.3\nv 0.01 0.9 0.3\nv 0 0.91 0.3\nf ", n + 1, " ", n + 2,
                       " ", n + 3, "\n");
    const Surface surface = surface_of(text);
    EXPECT_EQ(surface.positions.size(), 36u * 21);
    EXPECT_EQ(surface.indices.size(), tube.triangles().size());
    EXPECT_TRUE(has_note(surface.notes, "turned the other way round"));
    EXPECT_TRUE(has_note(surface.notes, "2 triangles are left out that are there twice"));
    const CookedGarment with_button = cook("mended.obj", text);
    EXPECT_EQ(with_button.garment.vertex_count(), 36u * 21);
    EXPECT_EQ(with_button.garment.drawn.indices.size(), tube.triangles().size() + 3);  // the button too
    ASSERT_EQ(with_button.garment.parts.size(), 2u);
    EXPECT_EQ(with_button.garment.parts[0].material, "buttons");
    EXPECT_TRUE(has_note(surface.notes, "1 faces are left out whose corners lie at one place or two"));
    std::set<std::pair<uint32_t, uint32_t>> sides;
    for (size_t i = 0; i < surface.indices.size(); ++i)
        EXPECT_TRUE(sides.insert({surface.indices[i], surface.indices[i - i % 3 + (i + 1) % 3]}).second);

    TubeMesh fine;
    fine.columns = 90, fine.rows = 60;  // squares of 8 mm
    std::vector<uint32_t> pierced = fine.squares();
    const size_t hole = 4 * (90 * 5 + 45);
    pierced.erase(pierced.begin() + std::ptrdiff_t(hole), pierced.begin() + std::ptrdiff_t(hole) + 4);
    fine.flare = 0.0f;
    const std::string with_hole = obj_vertices(fine.positions(), fine.uvs()) + obj_faces(pierced, 4);
    const Surface closed = surface_of(with_hole);
    EXPECT_EQ(closed.openings.size(), 3u);  // of 32 mm: it stays
    fine.rows = 90;
    pierced = fine.squares();
    pierced.erase(pierced.begin() + std::ptrdiff_t(hole), pierced.begin() + std::ptrdiff_t(hole) + 4);
    const Surface mended = surface_of(obj_vertices(fine.positions(), fine.uvs()) + obj_faces(pierced, 4));
    EXPECT_EQ(mended.openings.size(), 2u);
    EXPECT_TRUE(has_note(mended.notes, "1 holes of less than 30 mm around were closed"));
    EXPECT_EQ(mended.positions.size(), 90u * 91 + 1);
}

TEST_F(MeshGarment, PiecesThatAreNotJoinedBecomeOneOrAreNamed) {
    TubeMesh top, bottom;
    top.bottom_m = 0.8f;
    top.flare = bottom.flare = 0.0f;
    bottom.top_m = 0.798f;
    std::vector<uint32_t> below = bottom.squares();
    for (uint32_t& v : below) v += uint32_t(top.positions().size());
    CookRequest request =
        request_of(write("two.obj", obj_of(top) + obj_vertices(bottom.positions(), bottom.uvs()) +
                                        "usemtl hem\n" + obj_faces(below, 4)));
    const std::vector<CookedGarment> joined = cook_file(*model, fabrics, request, *jobs);
    ASSERT_EQ(joined.size(), 1u);
    EXPECT_EQ(joined[0].openings_m.size(), 2u);
    request.remake = Remake::never;
    expect_not_cooked(request, {"in pieces", "\"hem\"", "2 mm away"});
}

TEST_F(MeshGarment, LargeTrianglesStayOneGarment) {
    TubeMesh coarse;
    coarse.columns = 8, coarse.rows = 2;  // too few to fold
    CookRequest request = request_of(write("coarse.obj", obj_of(coarse)));
    for (const auto& [remake, note] :
         {std::pair(Remake::where_needed, "even triangles"), {Remake::always, "made anew"}}) {
        request.remake = remake;
        const std::vector<CookedGarment> made = cook_file(*model, fabrics, request, *jobs);
        ASSERT_EQ(made.size(), 1u);
        EXPECT_TRUE(has_note(made[0].notes, note));
        EXPECT_FALSE(has_note(made[0].notes, "holes"));
        EXPECT_EQ(made[0].openings_m.size(), 2u);
        EXPECT_EQ(made[0].garment.drawn.indices.size(), coarse.triangles().size());
    }
}

/// A tube with a strip between its legs, as of briefs: three openings.
std::string briefs(const std::function<Vec3(const Vec3&)>& written) {
    TubeMesh tube;
    tube.top_m = 0.98f, tube.bottom_m = 0.86f, tube.rows = 6, tube.radius_m = 0.135f, tube.flare = 0.1f;
    std::vector<Vec3> places = tube.positions();
    std::string faces = obj_faces(tube.squares(), 4);
    constexpr int kHalf = 3, kSteps = 14;
    const auto at = [&](int column) {
        return size_t(tube.rows * (tube.columns + 1) + (column + tube.columns) % tube.columns);
    };
    const size_t first = places.size();
    for (int step = 1; step < kSteps; ++step)
        for (int i = -kHalf; i <= kHalf; ++i) {
            const float t = float(step) / float(kSteps);
            Vec3 p = glm::mix(places[at(i)], places[at(tube.columns / 2 - i)], t);
            p.y -= 0.25f * std::sin(kPi * t);
            places.push_back(p);
        }
    const auto on_strip = [&](int step, int i) {
        if (step == 0) return at(i) + 1;
        if (step == kSteps) return at(tube.columns / 2 - i) + 1;
        return first + size_t(step - 1) * (2 * kHalf + 1) + size_t(i + kHalf) + 1;
    };
    for (int step = 0; step < kSteps; ++step)
        for (int i = -kHalf; i < kHalf; ++i)
            faces += vfit::text("f ", on_strip(step, i), " ", on_strip(step + 1, i), " ",
                                on_strip(step + 1, i + 1), " ", on_strip(step, i + 1), "\n");
    std::string out;
    for (const Vec3& p : places) {
        const Vec3 q = written(p);
        out += vfit::text("v ", q.x, " ", q.y, " ", q.z, "\n");
    }
    std::string plain;  // squares with uvs refer to none
    for (size_t i = 0; i < faces.size(); ++i)
        if (faces[i] == '/')
            while (i + 1 < faces.size() && faces[i + 1] != ' ' && faces[i + 1] != '\n') ++i;
        else
            plain += faces[i];
    return out + plain;
}

TEST_F(MeshGarment, BriefsAreTurnedUpright) {
    const CookedGarment upright = cook("briefs.obj", briefs([](const Vec3& p) { return p; }));
    EXPECT_EQ(upright.report.hangs_on, HangsOn::waist);
    EXPECT_EQ(upright.openings_m.size(), 3u);
    const CookedGarment turned = cook("z_up.obj", briefs([](const Vec3& p) { return Vec3(p.x, -p.z, p.y); }));
    EXPECT_TRUE(has_note(turned.notes, "Z up"));
    EXPECT_EQ(turned.report.hangs_on, HangsOn::waist);
    EXPECT_EQ(turned.round, upright.round);
}

TEST_F(MeshGarment, OfTwoWaysThatOneIsTakenInWhichItsFigureWoreIt) {
    // A tube with a large hole before and behind: a body gets through it either way.
    TubeMesh tube;
    tube.radius_m = 0.21f, tube.flare = 0.0f, tube.top_m = 1.1f, tube.bottom_m = 0.7f;
    std::vector<uint32_t> squares;
    const std::vector<uint32_t> all = tube.squares();
    const std::vector<Vec3> places = tube.positions();
    for (size_t i = 0; i < all.size(); i += 4) {
        const Vec3 middle =
            0.25f * (places[all[i]] + places[all[i + 1]] + places[all[i + 2]] + places[all[i + 3]]);
        if (std::abs(middle.y - 0.9f) > 0.17f || std::abs(middle.x) > 0.19f)
            squares.insert(squares.end(), &all[i], &all[i] + 4);
    }
    const CookBody body(*model, VFIT_SEX_FEMALE, {});
    const auto turn_of = [&](const std::function<Vec3(const Vec3&)>& written) {
        std::vector<Vec3> moved = places;
        for (Vec3& p : moved) p = written(p);
        const Model mesh = read_obj(obj_vertices(moved, tube.uvs()) + obj_faces(squares, 4), Beside());
        return align(make_pieces(make_soup(mesh, 1.0f)), body, {}).turn;
    };
    EXPECT_EQ(turn_of([](const Vec3& p) { return p; }), Mat3(1.0f));
    // About a figure that is written with Z up, it lies a metre beside the one that stands.
    EXPECT_NE(turn_of([](const Vec3& p) { return Vec3(p.x, -p.z, p.y); }), Mat3(1.0f));
    // By itself, it is as it was written.
    EXPECT_EQ(turn_of([](const Vec3& p) { return Vec3(p.x, -p.z, p.y) + Vec3(2.0f, 3.0f, 4.0f); }),
              Mat3(1.0f));
}

TEST_F(MeshGarment, WhatStandsObliquelyIsTurned) {
    const Garment shirt =
        cook_file(*model, fabrics, request_of(VFIT_SOURCE_DIR "/assets/garments/shirt_men.json"), *jobs)
            .front()
            .garment;
    const CookBody body(*model, VFIT_SEX_MALE, {});
    for (const float angle : {0.0f, 0.9f, -0.6f}) {
        const float c = std::cos(angle), s = std::sin(angle);
        const Mat3 oblique(Vec3(c, 0, -s), Vec3(0, 1, 0), Vec3(s, 0, c));
        std::vector<Vec3> places = shirt.mesh.positions;
        for (Vec3& p : places) p = oblique * p;
        const Model mesh = read_obj(
            obj_vertices(places, std::vector<Vec2>(places.size())) + obj_faces(shirt.mesh.indices, 3),
            Beside());
        const Alignment alignment = align(make_pieces(make_soup(mesh, 1.0f)), body, {});
        EXPECT_EQ(has_note(alignment.notes, "it stood obliquely, and was turned"), angle != 0.0f);
        constexpr float kNearly = 0.1f;  // its sleeves hang a little forward
        const Vec3 across = alignment.turn * oblique * Vec3(1, 0, 0);
        EXPECT_LT(glm::length(across - Vec3(1, 0, 0)), kNearly) << angle;
    }
}

TEST_F(MeshGarment, ATubeThatIsClosedAtOneEndIsAHatOrABag) {
    TubeMesh tube;
    const auto closed = [&](float lowered_m) {
        TubeMesh low = tube;
        low.top_m -= lowered_m, low.bottom_m -= lowered_m;
        const size_t n = low.positions().size();
        std::string lid = vfit::text("v 0 ", low.top_m, " 0\n");
        for (int i = 0; i < low.columns; ++i) lid += vfit::text("f ", i + 1, " ", i + 2, " ", n + 1, "\n");
        return obj_of(low) + lid;
    };
    CookRequest request = request_of(write("bag.obj", closed(0.7f)));
    expect_not_cooked(request, {"closed by cloth at one end", "--kind"});
    request.kind = "skirt";
    EXPECT_EQ(cook_file(*model, fabrics, request, *jobs).front().report.hangs_on, HangsOn::waist);
    // Where a figure wears its skirt, it's one.
    const CookedGarment skirt = cook("skirt.obj", closed(0.0f));
    EXPECT_TRUE(has_note(skirt.notes, "1 ends that were closed by cloth were cut open"));
}

TEST_F(MeshGarment, ASuitBecomesLayers) {
    // A skirt, and a wider and shorter one over it.
    TubeMesh inner, outer;
    outer.radius_m += 0.03f, outer.bottom_m = 0.75f;
    std::vector<uint32_t> over = outer.squares();
    for (uint32_t& v : over) v += uint32_t(inner.positions().size());
    const std::string obj = obj_of(outer);
    const std::vector<CookedGarment> suit =
        cook_file(*model, fabrics,
                  request_of(write("suit.obj", obj_of(inner) + obj_vertices(outer.positions(), outer.uvs()) +
                                                   obj_faces(over, 4))),
                  *jobs);
    ASSERT_EQ(suit.size(), 2u);
    EXPECT_EQ(suit[0].of_set, "skirt");
    EXPECT_EQ(suit[1].of_set, "skirt2");
    EXPECT_EQ(suit[0].garment.name, "suit_skirt");
    EXPECT_LT(suit[0].openings_m[1], suit[1].openings_m[1]);  // the innermost first
    for (const CookedGarment& one : suit) EXPECT_EQ(one.report.crossings(), 0u);
}

TEST(MeshSurface, CutsPolygonsThatAreNotConvex) {
    TubeMesh tube;
    // The squares of two rows as one L and what is left of them, all around.
    const std::vector<uint32_t> q = tube.squares();
    std::string faces;
    const auto at = [&](int r, int c) { return r * 37 + c + 1; };
    for (int c = 0; c < 36; c += 2) {
        faces += vfit::text("f ", at(0, c), " ", at(1, c), " ", at(2, c), " ", at(2, c + 1), " ",
                            at(2, c + 2), " ", at(1, c + 2), " ", at(1, c + 1), " ", at(0, c + 1), "\n");
        faces +=
            vfit::text("f ", at(0, c + 1), " ", at(1, c + 1), " ", at(1, c + 2), " ", at(0, c + 2), "\n");
    }
    const std::vector<uint32_t> rest(q.begin() + 4 * 72, q.end());
    const Surface surface =
        surface_of(obj_vertices(tube.positions(), tube.uvs()) + faces + obj_faces(rest, 4));
    EXPECT_EQ(surface.indices.size(), tube.triangles().size());
    EXPECT_EQ(surface.openings.size(), 2u);
}

TEST_F(MeshGarment, FilesAreTakenFromItsOwnFolderAlone) {
    std::ofstream(folder / "outside.mtl") << "newmtl cloth\nKd 1 0 0\n";
    std::ofstream(folder / "outside.png") << "x";
    write("inside.mtl", "newmtl cloth\nKd 0 1 0\nmap_Kd ..\\outside.png\n");
    const TubeMesh tube;
    const auto read = [&](const std::string& library) {
        return read_obj("mtllib " + library + "\nusemtl cloth\n" + obj_of(tube),
                        Beside((folder / "own").string()));
    };
    EXPECT_EQ(read("inside.mtl").materials[0].color, Vec3(0, 1, 0));
    EXPECT_TRUE(has_note(read("inside.mtl").notes, "outside of the garment's folder"));
    for (const std::string& library : {std::string("../outside.mtl"), (folder / "outside.mtl").string(),
                                       std::string("x/../../outside.mtl")}) {
        const Model model = read(library);
        EXPECT_EQ(model.materials[0].color, Vec3(0.8f)) << library;
        EXPECT_TRUE(has_note(model.notes, "outside of the garment's folder: it is not read")) << library;
    }
    EXPECT_TRUE(has_note(read("gone.mtl").notes, "\"gone.mtl\" is not there"));
    std::error_code failed;
    std::filesystem::create_symlink(folder / "outside.mtl", folder / "own" / "link.mtl", failed);
    EXPECT_TRUE(failed || has_note(read("link.mtl").notes, "outside"));
    EXPECT_TRUE(has_note(read("own").notes, "is not there"));
}

TinyGlb tube_glb() { return {TubeMesh().positions(), TubeMesh().uvs(), TubeMesh().triangles()}; }

Model read_glb(const TinyGlb& glb) {
    const std::string bytes = glb.bytes();
    return read_gltf(GltfDocument(std::as_bytes(std::span(bytes.data(), bytes.size()))), "shirt.glb",
                     Beside());
}

TEST(GltfGarment, IsReadWithItsNodesSkinsAndTextures) {
    TinyGlb glb = tube_glb();
    glb.json["nodes"] = {{{"translation", {0, 0.5, 0}}, {"scale", {0.5, 0.5, 0.5}}, {"children", {1}}},
                         {{"mesh", 0}, {"scale", {-1, 1, 1}}}};
    glb.json["images"] = {{{"bufferView", 0}, {"mimeType", "image/png"}}, {{"uri", "a%20b.png"}}};
    glb.json["textures"] = {{{"source", 0}}, {{"source", 1}}};
    glb.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
    const Model model = read_glb(glb);
    EXPECT_EQ(model.materials[0].texture, "shirt.glb#/images/0");
    const Vec3 first = TubeMesh().positions()[1];
    EXPECT_LT(glm::length(model.positions[1] - Vec3(-0.5f * first.x, 0.5f + 0.5f * first.y, 0.5f * first.z)),
              1e-6f);
    // Mirrored, the triangles are turned over with it.
    EXPECT_EQ(model.corners[1].position, TubeMesh().triangles()[2]);
    glb.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["index"] = 1;
    EXPECT_EQ(read_glb(glb).materials[0].texture, "a%20b.png");
    EXPECT_TRUE(has_note(read_glb(glb).notes, "\"a b.png\" of material \"linen\" is not there"));
    // On a bone that was moved: half a metre up.
    TinyGlb skinned = tube_glb();
    const size_t n = TubeMesh().positions().size();
    const std::vector<uint16_t> joints(4 * n, 0);
    std::vector<float> weights(4 * n, 0.0f);
    for (size_t i = 0; i < n; ++i) weights[4 * i] = 1.0f;
    skinned.json["meshes"][0]["primitives"][0]["attributes"]["JOINTS_0"] =
        skinned.add(joints.data(), joints.size() * 2, "VEC4", 5123, n);
    skinned.json["meshes"][0]["primitives"][0]["attributes"]["WEIGHTS_0"] =
        skinned.add(weights.data(), weights.size() * 4, "VEC4", 5126, n);
    skinned.json["nodes"] = {{{"mesh", 0}, {"skin", 0}}, {{"translation", {0, 0.5, 0}}}};
    skinned.json["skins"] = {{{"joints", {1}}}};
    EXPECT_LT(glm::length(read_glb(skinned).positions[1] - (first + Vec3(0, 0.5f, 0))), 1e-6f);
}

TEST(GltfGarment, UvsAreThoseOfThePicture) {
    TinyGlb glb = tube_glb();
    auto& texture = glb.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"];
    glb.json["images"] = {{{"uri", "a.png"}}};
    glb.json["textures"] = {{{"source", 0}}};
    texture = {{"index", 0}};
    const std::vector<Vec2> plain = read_glb(glb).uvs;
    // The example of the extension's text: a quarter turn about the origin, half the size, moved down.
    texture["extensions"]["KHR_texture_transform"] = {
        {"offset", {0.0, 1.0}}, {"rotation", 1.57079632679}, {"scale", {0.5, 0.5}}};
    const std::vector<Vec2> turned = read_glb(glb).uvs;
    ASSERT_EQ(turned.size(), plain.size());
    for (size_t i = 0; i < plain.size(); ++i)
        ASSERT_LT(glm::length(turned[i] - Vec2(0.5f * plain[i].y, 1.0f - 0.5f * plain[i].x)), 1e-5f);
    texture["extensions"]["KHR_texture_transform"] = {{"offset", {0.25, -0.5}}, {"scale", {2.0, 3.0}}};
    const std::vector<Vec2> scaled = read_glb(glb).uvs;
    for (size_t i = 0; i < plain.size(); ++i)
        ASSERT_LT(glm::length(scaled[i] - Vec2(2.0f * plain[i].x + 0.25f, 3.0f * plain[i].y - 0.5f)), 1e-5f);
    for (const auto& [key, value] : {std::pair("scale", nlohmann::json::array({1.0})),
                                     {"offset", nlohmann::json("x")},
                                     {"rotation", nlohmann::json("x")},
                                     {"scale", nlohmann::json::array({1e30, 1.0})}}) {
        texture["extensions"]["KHR_texture_transform"] = {{key, value}};
        EXPECT_THROW(read_glb(glb), Error) << key;
    }
}

TEST(GltfGarment, IsRefusedWithTheReason) {
    const auto refused = [](auto&& change, const char* word, vfit_result code = VFIT_ERROR_DATA) {
        TinyGlb glb = tube_glb();
        change(glb.json);
        try {
            surface_of(read_glb(glb));
            ADD_FAILURE() << "accepted: " << word;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), code) << error.what();
            EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
        }
    };
    refused(
        [](auto& j) {
            j["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
            j["extensionsUsed"] = {"EXT_mesh_gpu_instancing"};
        },
        "EXT_mesh_gpu_instancing", VFIT_ERROR_UNSUPPORTED);
    refused(
        [](auto& j) {
            j["accessors"][0]["sparse"] = {{"count", 1},
                                           {"indices", {{"bufferView", 0}, {"componentType", 5123}}},
                                           {"values", {{"bufferView", 0}}}};
        },
        "sparse", VFIT_ERROR_UNSUPPORTED);
    refused([](auto& j) { j["meshes"][0]["primitives"][0]["mode"] = 5; }, "strips", VFIT_ERROR_UNSUPPORTED);
    refused([](auto& j) { j["meshes"][0]["primitives"][0]["mode"] = 1; }, "no triangles");
    refused([](auto& j) { j["accessors"][0]["count"] = j["accessors"][1]["count"] = 100; }, "names vertex");
    refused([](auto& j) { j["accessors"][0]["count"] = 4000000000u; }, "beyond its buffer");
    refused([](auto& j) { j["accessors"][1]["count"] = 5; }, "TEXCOORD_0 has another count");
    refused([](auto& j) { j["accessors"][2]["count"] = 100; }, "whole triangles");
    refused([](auto& j) { j["nodes"][0]["mesh"] = 3; }, "mesh that is not there");
    refused([](auto& j) { j["nodes"][0]["skin"] = 3; }, "skin that is not there");
    refused([](auto& j) { j["nodes"][0]["scale"] = {0, 0, 0}; }, "no triangle with an area");
    refused([](auto& j) { j["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 7}}; },
            "texture that is not there");
    refused([](auto& j) { j["asset"]["version"] = "1.0"; }, "version", VFIT_ERROR_UNSUPPORTED);
    // A small file that asks for many copies.
    refused(
        [](auto& j) {
            for (int i = 0; i < 20000; ++i) j["nodes"].push_back({{"mesh", 0}});
        },
        "more than");
    TinyGlb nan = tube_glb();
    const float none = NAN;
    std::memcpy(nan.binary.data() + 12 * 5, &none, 4);
    try {
        read_glb(nan);
        ADD_FAILURE();
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("mesh \"shirt\", part 0: POSITION 5 is not finite"),
                  std::string::npos)
            << error.what();
    }
}

TEST_F(MeshGarment, TheFileIsNamedInWhatIsWrong) {
    try {
        cook("broken.obj", "v 0 0 0\nf 1 2 3\n");
        ADD_FAILURE();
    } catch (const Error& error) {
        EXPECT_EQ(std::string(error.what()), "broken.obj: line 2: the face names vertex 2 of 1");
    }
    EXPECT_THROW(cook("broken.glb", "glTF"), Error);
    EXPECT_THROW(cook("broken.gltf", "{}                   "), Error);
    EXPECT_THROW(cook_file(*model, fabrics, request_of((folder / "gone.obj").string()), *jobs), Error);
}

/// Bytes changed, left out and cut; whatever comes of it is a mesh or an error of ours.
template <typename Read>
int damaged(const std::string& good, uint32_t seed, int runs, const Read& read) {
    std::mt19937 bits(seed);
    int accepted = 0;
    for (int run = 0; run < runs; ++run) {
        std::string bad = good;
        if (run % 4 == 0)
            bad.resize(bits() % bad.size());
        else if (run % 4 == 1)
            bad.erase(bits() % bad.size(), bits() % 40);
        else
            for (uint32_t k = 0; k < 1 + bits() % 4; ++k)
                bad[bits() % bad.size()] = run % 4 == 2 ? char('0' + bits() % 10) : char(bits());
        try {
            read(bad);
            ++accepted;
        } catch (const Error& error) {
            EXPECT_TRUE(error.code() == VFIT_ERROR_DATA || error.code() == VFIT_ERROR_UNSUPPORTED)
                << error.what();
        }
    }
    return accepted;
}

TEST(MeshFiles, DamageIsAnErrorAndNothingElse) {
    TubeMesh small;
    small.columns = 12, small.rows = 5;
    EXPECT_GT(damaged(obj_of(small), 5, 800, [](const std::string& bad) { surface_of(bad); }), 50);
    const std::string glb = TinyGlb(small.positions(), small.uvs(), small.triangles()).bytes();
    EXPECT_GT(damaged(glb, 6, 800,
                      [](const std::string& bad) {
                          surface_of(read_gltf(GltfDocument(std::as_bytes(std::span(bad.data(), bad.size()))),
                                               "x.glb", Beside()));
                      }),
              20);
}

TEST_F(MeshGarment, WhatIsAcceptedAfterDamageIsAGarmentOrAnError) {
    TubeMesh small;
    small.columns = 12, small.rows = 5;
    EXPECT_GT(damaged(obj_of(small), 8, 12, [&](const std::string& bad) { cook("x.obj", bad); }), 1);
}

}  // namespace
}  // namespace vfit
