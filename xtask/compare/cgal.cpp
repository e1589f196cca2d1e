// CGAL's parameterizers on one mesh: `cgal METHOD IN.obj OUT.obj REPORT.json`; `cgal --list` prints the methods,
// `cgal --version` the versions of the libraries.
//
// Faces are triangulated by CGAL's own `triangulate_faces`, as its users do. No vertex is added, so one UV per vertex
// maps back to the polygons. The time is that of the solve alone.

#include <chrono>
#include <ctime>
#include <fstream>
#include <functional>
#include <iomanip>
#include <iostream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <CGAL/version.h>
#include <CGAL/version_macros.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Polygon_mesh_processing/border.h>
#include <CGAL/Polygon_mesh_processing/triangulate_faces.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_parameterization/ARAP_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/Barycentric_mapping_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/Circular_border_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/Discrete_authalic_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/Discrete_conformal_map_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/Error_code.h>
#include <CGAL/Surface_mesh_parameterization/Iterative_authalic_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/LSCM_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/Mean_value_coordinates_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/Two_vertices_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/parameterize.h>

namespace smp = CGAL::Surface_mesh_parameterization;
using Kernel = CGAL::Simple_cartesian<double>;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Halfedge = Mesh::Halfedge_index;
using UvMap = Mesh::Property_map<Mesh::Vertex_index, Kernel::Point_2>;
using Solve = std::function<smp::Error_code(Mesh&, Halfedge, UvMap)>;

struct Document {
    std::vector<std::string> kept;                // every line but `f`, `vt` and `vn`
    std::vector<std::vector<std::size_t>> faces;  // vertex indices from 0
    Mesh mesh;
};

Document read(const std::string& path) {
    Document document;
    std::ifstream file(path);
    std::string line;
    while (std::getline(file, line)) {
        std::istringstream words(line);
        std::string word;
        words >> word;
        if (word == "v") {
            double x, y, z;
            words >> x >> y >> z;
            document.mesh.add_vertex(Kernel::Point_3(x, y, z));
        } else if (word == "f") {
            document.faces.emplace_back();
            while (words >> word && word[0] != '#') {
                const long index = std::stol(word);
                const long count = static_cast<long>(document.mesh.number_of_vertices());
                document.faces.back().push_back(static_cast<std::size_t>(index > 0 ? index - 1 : count + index));
            }
        }
        if (word != "vt" && word != "vn" && line.rfind("f ", 0) != 0) document.kept.push_back(line);
    }
    for (const auto& face : document.faces) {
        std::vector<Mesh::Vertex_index> corners;
        for (const auto vertex : face) corners.emplace_back(static_cast<Mesh::size_type>(vertex));
        if (document.mesh.add_face(corners) == Mesh::null_face()) throw std::runtime_error("not a manifold");
    }
    return document;
}

void write(const std::string& path, const Document& document, const UvMap& uv) {
    std::ofstream file(path);
    file << std::setprecision(17);
    for (const auto& line : document.kept) file << line << '\n';
    for (const auto vertex : document.mesh.vertices()) file << "vt " << uv[vertex].x() << ' ' << uv[vertex].y() << '\n';
    for (const auto& face : document.faces) {
        file << 'f';
        for (const auto vertex : face) file << ' ' << vertex + 1 << '/' << vertex + 1;
        file << '\n';
    }
}

// The largest resident set so far, as JSON: `null` where the system does not tell.
std::string peak_memory_bytes() {
    std::ifstream status("/proc/self/status");
    std::string word;
    long kilobytes = 0;
    while (status >> word) {
        if (word == "VmHWM:" && status >> kilobytes) return std::to_string(kilobytes * 1024);
    }
    return "null";
}

template <class Parameterizer>
Solve with(Parameterizer parameterizer) {
    return [parameterizer](Mesh& mesh, Halfedge border, UvMap uv) mutable {
        return smp::parameterize(mesh, parameterizer, border, uv);
    };
}

std::map<std::string, Solve> methods() {
    using Circle = smp::Circular_border_arc_length_parameterizer_3<Mesh>;
    using Pins = smp::Two_vertices_parameterizer_3<Mesh>;
    return {
        {"cgal-tutte", with(smp::Barycentric_mapping_parameterizer_3<Mesh, Circle>())},
        {"cgal-mean-value", with(smp::Mean_value_coordinates_parameterizer_3<Mesh, Circle>())},
        {"cgal-conformal", with(smp::Discrete_conformal_map_parameterizer_3<Mesh, Circle>())},
        {"cgal-authalic", with(smp::Discrete_authalic_parameterizer_3<Mesh, Circle>())},
        {"cgal-iterative-authalic",
         [](Mesh& mesh, Halfedge border, UvMap uv) {
             smp::Iterative_authalic_parameterizer_3<Mesh, Circle> parameterizer;
             return parameterizer.parameterize(mesh, border, uv, 15);
         }},
        {"cgal-lscm", with(smp::LSCM_parameterizer_3<Mesh, Pins>())},
        // The balance is 0 for as-similar-as-possible; CGAL's default, 1000, for as-rigid-as-possible. 50 iterations.
        {"cgal-asap", with(smp::ARAP_parameterizer_3<Mesh>(0.0))},
        {"cgal-arap", with(smp::ARAP_parameterizer_3<Mesh>(1000.0))},
    };
}

int run(const std::string& method, const std::string& source, const std::string& target, const std::string& report) {
    Document document = read(source);
    CGAL::Polygon_mesh_processing::triangulate_faces(document.mesh);
    UvMap uv = document.mesh.add_property_map<Mesh::Vertex_index, Kernel::Point_2>("v:uv").first;
    const Halfedge border = CGAL::Polygon_mesh_processing::longest_border(document.mesh).first;
    Solve solve = methods().at(method);
    const auto wall = std::chrono::steady_clock::now();
    const auto cpu = std::clock();
    const smp::Error_code error = solve(document.mesh, border, uv);
    const double cpu_seconds = static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC;
    const std::chrono::duration<double> wall_seconds = std::chrono::steady_clock::now() - wall;
    if (error != smp::OK) {
        std::cerr << smp::get_error_message(error) << '\n';
        return 1;
    }
    write(target, document, uv);
    std::ofstream(report) << "{\"solve_seconds\": " << wall_seconds.count()
                          << ", \"solve_cpu_seconds\": " << cpu_seconds
                          << ", \"peak_memory_bytes\": " << peak_memory_bytes() << "}\n";
    return 0;
}

int main(int count, char** arguments) {
    if (count == 2 && std::string(arguments[1]) == "--list") {
        for (const auto& method : methods()) std::cout << method.first << '\n';
        return 0;
    }
    if (count == 2 && std::string(arguments[1]) == "--version") {
        std::cout << "CGAL " << CGAL_VERSION_STR << " (Eigen " << EIGEN_WORLD_VERSION << '.' << EIGEN_MAJOR_VERSION << '.'
                  << EIGEN_MINOR_VERSION << ")\n";
        return 0;
    }
    if (count != 5) return 2;
    try {
        return run(arguments[1], arguments[2], arguments[3], arguments[4]);
    } catch (const std::exception& error) {
        std::cerr << error.what() << '\n';
        return 1;
    }
}
