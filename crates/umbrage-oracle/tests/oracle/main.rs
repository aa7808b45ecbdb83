//! Tests of the oracle and its measures against answers that are known without it.
mod bias;
mod bodies;
mod diagnose;
mod exact;
mod faults;
mod holes;
mod judge;
mod metrics;
mod predict;
mod rays;
mod silhouette;
mod transparent;
mod truth;
