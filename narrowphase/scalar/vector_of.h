// Vectors of any number type: exact numbers for the proofs of decisions, doubles for what prepares
// them.
#pragma once

namespace carom {

template <class Number>
struct VectorOf {
  Number x, y, z;

  friend VectorOf operator+(const VectorOf& a, const VectorOf& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  friend VectorOf operator-(const VectorOf& a, const VectorOf& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
  friend VectorOf operator-(const VectorOf& a) { return {-a.x, -a.y, -a.z}; }
  friend VectorOf operator*(const VectorOf& a, const Number& s) {
    return {a.x * s, a.y * s, a.z * s};
  }
};

template <class Number>
Number dot(const VectorOf<Number>& a, const VectorOf<Number>& b) {
  return (a.x * b.x + a.y * b.y) + a.z * b.z;
}

template <class Number>
VectorOf<Number> cross(const VectorOf<Number>& a, const VectorOf<Number>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

}  // namespace carom
