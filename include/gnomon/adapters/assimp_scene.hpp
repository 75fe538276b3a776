// SPDX-License-Identifier: BSL-1.0
/// @file
/// Reads scenes from mesh files (OBJ, STL, DAE, glTF and the other formats of Assimp). Link with
/// gnomon::assimp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>

#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <gnomon/core/error.hpp>
#include <gnomon/simulation/polyhedron.hpp>
#include <gnomon/simulation/scene.hpp>
#include <gnomon/simulation/triangle_mesh.hpp>

namespace gnomon::simulation {

/// The meaning of the named groups of a mesh file.
enum class mesh_groups : char {
    objects,  ///< each group is an object with one part, "body"
    parts     ///< each group is a part of one object, named after the file without folder and
              ///< extension
};

namespace detail {

/// Adds the meshes of a file to a scene, group by group.
class assimp_reader {
  public:
    assimp_reader(const std::string& path, mesh_groups groups, scene& world)
        : groups_(groups), world_(world) {
        const std::size_t name = path.find_last_of("/\\") + 1;  // 0 without folder
        file_ = path.substr(name, path.find_last_of('.') - name);
    }

    /// Adds the meshes of a node and of its descendants. `outer` is the transformation of the
    /// node's parent.
    void add(const aiScene& file, const aiNode& node, const aiMatrix4x4& outer) {
        const aiMatrix4x4 place = outer * node.mTransformation;
        polyhedron faces;  // of all materials
        for (unsigned i = 0; i < node.mNumMeshes; ++i)
            append(*file.mMeshes[node.mMeshes[i]], place, faces);
        if (!faces.triangles.empty()) {
            std::string name = node.mName.C_Str();
            if (node.mNumMeshes == 1 && file.mMeshes[node.mMeshes[0]]->mName.length > 0)
                name = file.mMeshes[node.mMeshes[0]]->mName.C_Str();
            if (name.empty()) name = file_;
            triangle_mesh mesh(std::move(faces));
            world_.add(part(std::move(name)), std::move(mesh));
        }
        for (unsigned i = 0; i < node.mNumChildren; ++i) add(file, *node.mChildren[i], place);
    }

  private:
    static void append(const aiMesh& mesh, const aiMatrix4x4& place, polyhedron& faces) {
        const auto first = static_cast<std::uint32_t>(faces.vertices.size());
        for (unsigned t = 0; t < mesh.mNumFaces; ++t) {
            const aiFace& face = mesh.mFaces[t];
            if (face.mNumIndices != 3) continue;  // points and lines
            faces.triangles.push_back(
                {first + face.mIndices[0], first + face.mIndices[1], first + face.mIndices[2]});
        }
        for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
            const aiVector3D p = place * mesh.mVertices[v];
            faces.vertices.push_back({p.x, p.y, p.z});
        }
    }

    std::int32_t part(std::string name) {
        if (groups_ == mesh_groups::objects)
            return world_.add_part(world_.add_object(std::move(name)), "body");
        if (object_ == nothing) object_ = world_.add_object(file_);
        return world_.add_part(object_, std::move(name));
    }

    mesh_groups groups_;
    scene& world_;
    std::string file_;
    std::int32_t object_ = nothing;
};

}  // namespace detail

/// Reads a scene from a mesh file, in the file's axes and units (COLLADA, which declares its unit,
/// in metres). Each named group becomes a mesh with a single surface, regardless of its materials.
/// Assimp stores coordinates in single precision: translate meshes far from the origin beforehand.
/// The sensor stays at the origin. Complexity: O(n log n).
/// @throws gnomon::error  if the file cannot be read, contains no triangle, or is invalid; a text
///                        file truncated at the end of a line is not recognized as invalid
[[nodiscard]] inline scene read_scene(const std::string& path,
                                      mesh_groups groups = mesh_groups::objects) {
    Assimp::Importer importer;
    importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
    const aiScene* const file =
        importer.ReadFile(path, aiProcess_ValidateDataStructure | aiProcess_Triangulate |
                                    aiProcess_JoinIdenticalVertices);
    if (file == nullptr || file->mRootNode == nullptr)
        throw error(path, "", importer.GetErrorString());
    scene world;
    try {
        detail::assimp_reader(path, groups, world).add(*file, *file->mRootNode, aiMatrix4x4());
    } catch (const std::invalid_argument& problem) {
        throw error(path, "", problem.what());
    }
    if (world.shapes().empty()) throw error(path, "", "no triangles");
    return world;
}

}  // namespace gnomon::simulation
