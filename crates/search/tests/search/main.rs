//! Every search against brute force, on random graphs and on degenerate ones.

mod astar;
mod dijkstra;
mod graphs;
mod refusals;
mod traversal;
