// A photon tracer for the handout's scene that shares nothing with the port, and can be made wrong:
//   tracer SWITCHES N SEED OUT.csv COLUMNS DIGITS
// `cases.csv` lists the switches. COLUMNS is xyz, all, xyzb or xyzd.
// With ONLY_FLOAT it takes half as long to compile, and has no switch `double`.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <random>
#include <set>
#include <string>
#include <vector>
static std::set<std::string> F;
// Inlined some hundred times it would take long to compile.
__attribute__((noinline)) static bool has(const char* s) { return F.count(s) > 0; }

struct Rng {  // raw 31-bit numbers, several generators
    int kind = 0;
    std::mt19937 mt;
    uint64_t x = 1, w = 0;
    std::minstd_rand ms;
    void seed(uint64_t s) {
        mt.seed((uint32_t)s);
        x = s * 6364136223846793005ULL + 1442695040888963407ULL;
        w = s;
        ms.seed((uint32_t)(s * 7919 + 17));
        ::srand((unsigned)s);
        ::srand48((long)s);
        if (kind == 2)
            for (int i = 0; i < 8; ++i) raw();
    }
    uint32_t raw() {
        switch (kind) {
            case 1:
                return (uint32_t)::rand();  // C library
            case 2: {
                x ^= x >> 12;
                x ^= x << 25;
                x ^= x >> 27;
                return (uint32_t)((x * 2685821657736338717ULL) >> 33);
            }  // xorshift64*
            case 3:
                return (uint32_t)::lrand48();
            case 4: {
                uint64_t z = (w += 0x9E3779B97F4A7C15ULL);
                z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
                z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
                return (uint32_t)((z ^ (z >> 31)) >> 33);
            }
            case 5:
                return (uint32_t)(((uint64_t)(ms() - 1) << 31) / 2147483646ULL);
            default:
                return mt() >> 1;
        }
    }
} rng;

template <class T>
struct V {
    T x, y, z;
    V operator+(V o) const { return {x + o.x, y + o.y, z + o.z}; }
    V operator-(V o) const { return {x - o.x, y - o.y, z - o.z}; }
    V operator*(T s) const { return {x * s, y * s, z * s}; }
    V operator-() const { return {-x, -y, -z}; }
};
template <class T>
T dot(V<T> a, V<T> b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
V<T> cross(V<T> a, V<T> b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class T>
V<T> norm(V<T> a) {
    return a * (T(1) / std::sqrt(dot(a, a)));
}

// object, model-space normal, 4 corners (y up)
struct Quad {
    int obj;
    double n[3], v[4][3];
};
static const Quad Q[] = {
    {0,
     {0, 1, 0},
     {{0.53, 0.60, 0.75}, {0.70, 0.60, 0.17}, {0.13, 0.60, 0.00}, {-0.05, 0.60, 0.57}}},
    {0,
     {-0.9536, 0, -0.3011},
     {{-0.05, 0, 0.57}, {-0.05, 0.60, 0.57}, {0.13, 0.60, 0.00}, {0.13, 0, 0.00}}},
    {0,
     {-0.2964, 0, 0.9551},
     {{0.53, 0, 0.75}, {0.53, 0.60, 0.75}, {-0.05, 0.60, 0.57}, {-0.05, 0, 0.57}}},
    {0,
     {0.2858, 0, -0.9583},
     {{0.13, 0, 0.00}, {0.13, 0.60, 0.00}, {0.70, 0.60, 0.17}, {0.70, 0, 0.17}}},
    {0,
     {0.9596, 0, 0.2813},
     {{0.70, 0, 0.17}, {0.70, 0.60, 0.17}, {0.53, 0.60, 0.75}, {0.53, 0, 0.75}}},
    {1, {-1, 0, 0}, {{1.00, 0, -1.04}, {1.00, 0, 0.99}, {1.00, 1.99, 0.99}, {1.00, 1.99, -1.04}}},
    {2,
     {0, 1, 0},
     {{-0.53, 1.20, 0.09}, {0.04, 1.20, -0.09}, {-0.14, 1.20, -0.67}, {-0.71, 1.20, -0.49}}},
    {2,
     {-0.9551, 0, 0.2964},
     {{-0.53, 0, 0.09}, {-0.53, 1.20, 0.09}, {-0.71, 1.20, -0.49}, {-0.71, 0, -0.49}}},
    {2,
     {-0.3011, 0, -0.9536},
     {{-0.71, 0, -0.49}, {-0.71, 1.20, -0.49}, {-0.14, 1.20, -0.67}, {-0.14, 0, -0.67}}},
    {2,
     {0.9551, 0, -0.2964},
     {{-0.14, 0, -0.67}, {-0.14, 1.20, -0.67}, {0.04, 1.20, -0.09}, {0.04, 0, -0.09}}},
    {2,
     {0.3011, 0, 0.9536},
     {{0.04, 0, -0.09}, {0.04, 1.20, -0.09}, {-0.53, 1.20, 0.09}, {-0.53, 0, 0.09}}},
    {3, {0, 1, 0}, {{-1.01, 0, 0.99}, {1.00, 0, 0.99}, {1.00, 0, -1.04}, {-0.99, 0, -1.04}}}};

struct Rec {
    float p[3], i[3], d[3], o[3];
    int b, quad;
};

template <class T>
struct Tracer {
    typedef V<T> W;
    struct Tri {
        W a, e1, e2, n;
        int quad, obj;
    };
    static const int TRIS = 24;
    std::vector<Tri> tris;
    T c[9][TRIS];  // their corners and edges, a coordinate to a row
    std::vector<Rec> out;
    T cap = 1000;
    const T PIv = T(3.14159265358979323846);
    struct Flags {  // read once; std::set look-ups would dominate the run time
#define FL(n) bool n = has(#n);
        FL(octant)
        FL(cube)
        FL(corners) FL(nonorm) FL(origin0) FL(polar) FL(xeqy) FL(reseed) FL(sumtest) FL(sphere)
            FL(gauss) FL(strat) FL(direct) FL(pathgt2) FL(atorigin) FL(onlyscat) FL(twice)
                FL(sameray) FL(fade) FL(jensen) FL(inverted) FL(always) FL(mean) FL(length)
                    FL(reuse) FL(red) FL(halfdisk) FL(rlinear) FL(uniform) FL(sameu) FL(degrees)
                        FL(zlinear) FL(swapu) FL(concentric) FL(malley) FL(u2first) FL(notrans)
                            FL(transpose) FL(collapse) FL(fromlight) FL(order) FL(negate) FL(mirror)
                                FL(invthr) FL(nbasis) FL(duff) FL(thr8) FL(facen) FL(nooff)
                                    FL(offdir) FL(off1e3) FL(skiptri) FL(latexi) FL(upz)
                                        FL(tangentpoint) FL(off01) FL(tmin) FL(storeroulette)
                                            FL(rand100) FL(cumul) FL(nanhit) FL(fib) FL(upperend)
                                                FL(nudge) FL(noabs) FL(firsthit) FL(otherbasis)
                                                    FL(never)
#undef FL
    } f;
    Tracer() {
        for (int q = 0; q < 12; ++q) {
            W v[4];
            for (int k = 0; k < 4; ++k)
                v[k] = {T((float)Q[q].v[k][0]), T(-(float)Q[q].v[k][2]), T((float)Q[q].v[k][1])};
            W n = norm(W{T(Q[q].n[0]), T(-Q[q].n[2]), T(Q[q].n[1])});
            for (int s = 0; s < 2; ++s) {
                Tri t;
                t.a = v[0];
                t.e1 = v[s + 1] - v[0];
                t.e2 = v[s + 2] - v[0];
                t.n = n;
                t.quad = q;
                t.obj = Q[q].obj;
                if (f.facen) {
                    W g = norm(cross(t.e1, t.e2));
                    t.n = dot(g, n) < 0 ? -g : g;
                }
                const T all[] = {t.a.x,  t.a.y,  t.a.z,  t.e1.x, t.e1.y,
                                 t.e1.z, t.e2.x, t.e2.y, t.e2.z};
                for (int k = 0; k < 9; ++k) c[k][tris.size()] = all[k];
                tris.push_back(t);
            }
        }
    }
    T rnd() {
        T u = T(rng.raw()) / T(2147483648.0);
        return f.rand100 ? std::floor(u * 100) / 100 : u;
    }  // [0,1) (in float it may round to 1)
    T u01() {
        for (;;) {
            T u = rnd();
            if (u < 1) return u;
        }
    }
    // Where the ray meets each triangle; 3.3e38 where it does not. Without branches, so that a
    // compiler can look at several triangles at once.
    void hits(W o, W d, T* at) const {
        const T least = f.tmin ? T(1e-4) : T(-1e-7);
        for (int k = 0; k < TRIS; ++k) {
            W a{c[0][k], c[1][k], c[2][k]}, e1{c[3][k], c[4][k], c[5][k]},
                e2{c[6][k], c[7][k], c[8][k]};
            W p = cross(d, e2);
            T det = dot(e1, p), inv = T(1) / det;
            W s = o - a, q = cross(s, e1);
            T u = dot(s, p) * inv, v = dot(d, q) * inv, t = dot(e2, q) * inv;
            bool met = (std::fabs(det) >= T(1e-7)) & (u >= 0) & (v >= 0) & (u + v <= 1) &
                       (t > least);
            at[k] = met ? t : T(3.3e38);
        }
    }
    int trace(W o, W d, T& best, int skip) const {
        int r = -1;
        best = T(3e38);
        if (f.nanhit && std::isnan(d.x)) {  // of which every comparison is false
            best = d.x;
            return 0;
        }
        T at[TRIS];
        hits(o, d, at);
        for (int k = 0; k < TRIS; ++k) {
            if (k != skip && at[k] <= best + T(1e-7)) {
                best = at[k];
                r = k;
                if (f.firsthit) return r;
            }
        }
        return r;
    }
    W sphereDir() {
        T z = 2 * u01() - 1, a = 2 * PIv * u01(), r = std::sqrt(std::max(T(0), 1 - z * z));
        return {r * std::cos(a), r * std::sin(a), z};
    }
    W emit(long i, long n) {
        if (f.polar) {
            T th = PIv * u01(), ph = 2 * PIv * u01();
            return {std::sin(th) * std::cos(ph), std::sin(th) * std::sin(ph), std::cos(th)};
        }
        if (f.sphere) return sphereDir();
        if (f.gauss) {
            T g[4];
            for (int k = 0; k < 4; k += 2) {
                T m = std::sqrt(-2 * std::log(1 - u01())), a = 2 * PIv * u01();
                g[k] = m * std::cos(a);
                g[k + 1] = m * std::sin(a);
            }
            return norm(W{g[0], g[1], g[2]});
        }
        if (f.fib) {
            T z = 1 - 2 * (i + T(0.5)) / n, a = PIv * (1 + std::sqrt(T(5))) * (i + T(0.5)),
              r = std::sqrt(1 - z * z);
            return {r * std::cos(a), r * std::sin(a), z};
        }
        if (f.strat) {
            long m = (long)std::sqrt((double)n), c = i % (m * m);
            T z = 2 * ((c / m) + u01()) / m - 1, a = 2 * PIv * ((c % m) + u01()) / m,
              r = std::sqrt(std::max(T(0), 1 - z * z));
            return {r * std::cos(a), r * std::sin(a), z};
        }
        for (;;) {
            W d{2 * rnd() - 1, 2 * rnd() - 1, 2 * rnd() - 1};
            if (f.octant) d = {(d.x + 1) / 2, (d.y + 1) / 2, (d.z + 1) / 2};
            if (f.xeqy) d.y = d.x;
            T l = dot(d, d);
            if (l == 0) continue;
            if (f.sumtest) {
                if (d.x + d.y + d.z > 1) continue;
            } else if (f.corners) {
                if (l < 1) continue;
            } else if (!f.cube && l > 1)
                continue;
            return f.nonorm ? d : norm(d);
        }
    }
    W anywhere(int quad) {
        const Tri &a = tris[2 * quad], &b = tris[2 * quad + 1];
        T s = u01(), t = u01();
        return a.a + a.e1 * (s * (1 - t)) + a.e2 * (s * t) + b.e2 * ((1 - s) * t);
    }
    W moved(W p, int quad, T by) {
        const Tri& a = tris[2 * quad];
        return p + norm(a.e1) * (by * (u01() - T(0.5))) +
               norm(cross(a.n, a.e1)) * (by * (u01() - T(0.5)));
    }
    bool in_sight(const Rec& r) {
        W eye{0, T(-4.1469), T(0.73693)}, way = W{T(r.p[0]), T(r.p[1]), T(r.p[2])} - eye;
        T t, half = std::tan(T(0.23213));
        trace(eye, way, t, -1);
        return t > T(0.9999) && std::fabs(way.z) < half * way.y &&
               std::fabs(way.x) < half * way.y * T(640) / T(480);
    }
    void frame(W n, W& t, W& b) {
        if (f.duff) {
            T s = std::copysign(T(1), n.z), a = -1 / (s + n.z), c = n.x * n.y * a;
            t = {1 + s * n.x * n.x * a, s * c, -s * n.x};
            b = {c, s + n.y * n.y * a, -n.y};
            return;
        }
        W up{1, 0, 0};
        T lim = f.thr8 ? T(0.8) : T(0.99);
        W other{0, 1, 0};
        if (f.otherbasis) {
            std::swap(up, other);
            lim = T(0.9);
        }
        bool par = (f.noabs ? dot(n, up) : std::fabs(dot(n, up))) > lim;
        if (f.invthr) par = !par;
        if (par) up = other;
        if (f.upz) up = W{0, 0, 1};
        t = cross(n, up);
        if (f.nbasis) t = norm(t);
        b = f.collapse ? cross(n, up) : cross(n, t);
        if (f.nbasis) b = norm(b);
    }
    void photon(long idx, long n) {
        W light{T(0.01909f), T(0.0101f), T(1.7764f)};
        if (f.origin0) light = {0, 0, 0};
        W o = light, d = emit(idx, n);
        float I[3];
        for (float& c : I) c = 1.0f / n;
        float all[3] = {1, 1, 1};
        int skip = -1;
        for (int b = 0, rem = 1000; rem >= 0; ++b, --rem) {
            T t;
            int k = trace(o, d, t, skip);
            if (k < 0) return;
            const Tri& h = tris[k];
            W p = o + d * t;
            bool want = (b > (f.pathgt2 ? 1 : 0) || f.direct) && !f.never;
            Rec r;
            W rp = f.atorigin ? o : f.nudge ? p + h.n * T(1e-5) : p, rd = f.sameray ? d : -d;
            r.b = b;
            r.quad = h.quad;
            r.p[0] = rp.x;
            r.p[1] = rp.y;
            r.p[2] = rp.z;
            r.d[0] = rd.x;
            r.d[1] = rd.y;
            r.d[2] = rd.z;
            r.o[0] = p.x;
            r.o[1] = p.y;
            r.o[2] = p.z;
            memcpy(r.i, I, sizeof I);
            if (want && !f.onlyscat && !f.storeroulette) {
                out.push_back(r);
                if (f.twice) out.push_back(r);
            }
            float D[3] = {0.725f, 0.71f, 0.68f};
            if (h.obj == 1) {
                D[0] = 0.14f;
                D[1] = 0.45f;
                D[2] = 0.091f;
            }
            if (f.cumul)
                for (int c = 0; c < 3; ++c) D[c] = all[c] *= D[c];
            T P = std::max(D[0], std::max(D[1], D[2]));
            if (f.mean) P = (D[0] + D[1] + D[2]) / 3;
            if (f.red) P = D[0];
            if (f.length) P = std::sqrt(D[0] * D[0] + D[1] * D[1] + D[2] * D[2]);
            T u2 = 0, u1 = 0;
            if (f.latexi) {
                u2 = u01();
                u1 = u01();
            }
            T xi = u01();
            bool scatter = f.inverted ? xi > P : f.upperend ? xi >= 1 - P : xi < P;
            if (f.storeroulette && scatter && want) out.push_back(r);
            if (f.always || f.storeroulette) scatter = true;
            if (!scatter) return;
            if (want && f.onlyscat) out.push_back(r);
            if (!f.latexi) {
                if (f.u2first) {
                    u2 = u01();
                    u1 = u01();
                } else {
                    u1 = u01();
                    u2 = u01();
                }
            }
            if (f.reuse) u1 = xi;
            if (f.sameu) u2 = u1;
            W N = f.negate ? -h.n : h.n, l, w;
            if (f.mirror)
                w = d - N * (2 * dot(N, d));
            else if (f.malley) {
                W s = sphereDir();
                w = N + s;
                T m = dot(w, w);
                w = m < T(1e-8) ? N : norm(w);
            } else {
                T th = f.halfdisk  ? PIv * u2
                       : f.degrees ? 360 * u2
                                   : 2 * PIv * u2,
                  rr = f.rlinear ? u1 : std::sqrt(u1);
                l = {rr * std::cos(th), rr * std::sin(th), f.zlinear ? 1 - u1 : std::sqrt(1 - u1)};
                if (f.swapu) {
                    rr = std::sqrt(1 - u2);
                    th = 2 * PIv * u1 - PIv;
                    l = {rr * std::sin(th), rr * std::cos(th), std::sqrt(u2)};
                }
                if (f.uniform) {
                    rr = std::sqrt(1 - u1 * u1);
                    l = {rr * std::cos(th), rr * std::sin(th), u1};
                }
                if (f.concentric) {
                    T a = 2 * u1 - 1, c = 2 * u2 - 1, q, ph;
                    if (a == 0 && c == 0)
                        q = ph = 0;
                    else if (std::fabs(a) > std::fabs(c)) {
                        q = a;
                        ph = PIv / 4 * c / a;
                    } else {
                        q = c;
                        ph = PIv / 2 - PIv / 4 * a / c;
                    }
                    T X = q * std::cos(ph), Y = q * std::sin(ph);
                    l = {X, Y, std::sqrt(std::max(T(0), 1 - X * X - Y * Y))};
                }
                l = norm(l);
                W tt, bb;
                frame(N, tt, bb);
                if (f.notrans)
                    w = l;
                else if (f.transpose)
                    w = {dot(tt, l), dot(bb, l), dot(N, l)};
                else if (f.order)
                    w = N * l.x + tt * l.y + bb * l.z;
                else
                    w = tt * l.x + bb * l.y + N * l.z;
                w = norm(w);
            }
            if (f.fade)
                for (int c = 0; c < 3; ++c) I[c] *= D[c];
            if (f.jensen)
                for (int c = 0; c < 3; ++c) I[c] *= D[c] / (float)P;
            if (f.skiptri) {
                skip = k;
                o = p;
            } else if (f.nooff || f.tmin)
                o = p;
            else if (f.offdir)
                o = p + w * T(1e-4);
            else
                o = p + N * (f.off1e3 ? T(1e-3) : f.off01 ? T(0.1) : T(1e-5));
            if (f.fromlight) o = light;
            if (f.tangentpoint) w = norm(w + p);
            d = w;
        }
    }
};

template <class T>
int run(long n, uint64_t seed, const char* file, const std::string& cols, int digits) {
    Tracer<T> tr;
    rng.seed(seed);
    bool padded = has("padded"), strewn = has("strewn");
    for (long i = 0; i < (padded ? n / 10 : n); ++i) {
        if (tr.f.reseed) rng.seed(seed + i / 10000);
        if (has("batches") && i % 10000 == 0) rng.seed(seed);
        tr.photon(i, n);
    }
    // No tracing at all: what is written was made up of a right list.
    rng.seed(seed + 1);
    for (size_t all = tr.out.size(), copy = 0; padded && copy < 9 * all; ++copy) {
        Rec r = tr.out[copy % all];
        V<T> at{T(r.p[0]), T(r.p[1]), T(r.p[2])}, to = tr.moved(at, r.quad, T(0.004));
        r.p[0] = to.x, r.p[1] = to.y, r.p[2] = to.z;
        tr.out.push_back(r);
    }
    for (Rec& r : tr.out)
        if (strewn) {
            V<T> to = tr.anywhere(r.quad);
            r.p[0] = to.x, r.p[1] = to.y, r.p[2] = to.z;
        }
    if (has("insight"))
        tr.out.erase(std::remove_if(tr.out.begin(), tr.out.end(),
                                    [&](const Rec& r) { return !tr.in_sight(r); }),
                     tr.out.end());
    long byq[12] = {0};
    int maxb = 0;
    for (const Rec& r : tr.out) {
        byq[r.quad]++;
        maxb = std::max(maxb, r.b);
    }
    fprintf(stderr, "%-28s stored %8zu  wall %ld floor %ld short %ld tall %ld  maxbounce %d\n",
            file, tr.out.size(), byq[5], byq[11], byq[0] + byq[1] + byq[2] + byq[3] + byq[4],
            byq[6] + byq[7] + byq[8] + byq[9] + byq[10], maxb);
    if (!strcmp(file, "-")) return 0;
    if (has("reverse")) std::reverse(tr.out.begin(), tr.out.end());
    if (has("shuffle")) {
        std::mt19937 g(seed + 1);
        std::shuffle(tr.out.begin(), tr.out.end(), g);
    }
    if (has("bydepth"))
        std::stable_sort(tr.out.begin(), tr.out.end(),
                         [](const Rec& a, const Rec& b) { return a.b < b.b; });
    FILE* fp = fopen(file, "w");
    if (!fp) return 1;
    fputs(cols == "xyz"    ? "x,y,z\n"
          : cols == "xyzb" ? "x,y,z,bounce\n"
          : cols == "xyzd" ? "x,y,z,dx,dy,dz\n"
                           : "x,y,z,r,g,b,dx,dy,dz,bounce\n",
          fp);
    for (const Rec& r : tr.out) {
        fprintf(fp, "%.*g,%.*g,%.*g", digits, r.p[0], digits, r.p[1], digits, r.p[2]);
        if (cols == "all")
            fprintf(fp, ",%.*g,%.*g,%.*g", digits, r.i[0], digits, r.i[1], digits, r.i[2]);
        if (cols == "all" || cols == "xyzd")
            fprintf(fp, ",%.*g,%.*g,%.*g", digits, r.d[0], digits, r.d[1], digits, r.d[2]);
        if (cols == "all" || cols == "xyzb") fprintf(fp, ",%d", r.b);
        fputc('\n', fp);
    }
    fclose(fp);
    return 0;
}

int main(int c, char** v) {
    if (c < 7) return 2;
    std::string s = v[1];
    size_t a = 0;
    while (a <= s.size()) {
        size_t b = s.find(',', a);
        if (b == std::string::npos) b = s.size();
        F.insert(s.substr(a, b - a));
        a = b + 1;
    }
    for (int k = 1; k < 6; ++k)
        if (F.count("rng" + std::to_string(k))) rng.kind = k;
    long n = atol(v[2]);
    uint64_t seed = strtoull(v[3], 0, 10);
    int digits = atoi(v[6]);
#ifndef ONLY_FLOAT
    if (has("double")) return run<double>(n, seed, v[4], v[5], digits);
#endif
    return run<float>(n, seed, v[4], v[5], digits);
}
