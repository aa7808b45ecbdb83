//! Shortest circles of a graph.

use std::collections::{BTreeMap, BTreeSet, VecDeque};

/// Circles that share no step, shortest first, until none is left; each begins with its lowest node.
pub fn shortest_circles(steps: impl Iterator<Item = (usize, usize)>) -> Vec<Vec<usize>> {
    let mut steps: BTreeSet<(usize, usize)> = steps.collect();
    let mut circles = Vec::new();
    while let Some(circle) = shortest(&steps) {
        for index in 0..circle.len() {
            steps.remove(&(circle[index], circle[(index + 1) % circle.len()]));
        }
        circles.push(circle);
    }
    circles
}

fn shortest(steps: &BTreeSet<(usize, usize)>) -> Option<Vec<usize>> {
    let nodes: BTreeSet<usize> = steps.iter().map(|(from, _)| *from).collect();
    // The first of the shortest ones is found from its lowest node.
    nodes.into_iter().filter_map(|node| back_to(node, steps)).min_by_key(Vec::len)
}

/// The shortest way from a node back to itself, breadth first.
fn back_to(start: usize, steps: &BTreeSet<(usize, usize)>) -> Option<Vec<usize>> {
    let mut came_from = BTreeMap::new();
    let mut waiting = VecDeque::from([start]);
    while let Some(node) = waiting.pop_front() {
        for &(_, next) in steps.range((node, 0)..=(node, usize::MAX)) {
            if next == start {
                let mut way = vec![node];
                while let Some(&before) = way.last().and_then(|last| came_from.get(last)) {
                    way.push(before);
                }
                way.reverse();
                return Some(way);
            }
            if next != node && !came_from.contains_key(&next) {
                came_from.insert(next, node);
                waiting.push_back(next);
            }
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shortest_circles_come_first_and_each_step_once() {
        let of = |steps: &[(usize, usize)]| shortest_circles(steps.iter().copied());
        assert!(of(&[(0, 1), (1, 2), (0, 2)]).is_empty());
        assert_eq!(of(&[(0, 1), (1, 2), (2, 0), (2, 1)]), [vec![1, 2]]);
        assert_eq!(of(&[(0, 1), (1, 2), (2, 0), (4, 3), (3, 4)]), [vec![3, 4], vec![0, 1, 2]]);
        assert_eq!(of(&[(5, 5)]), [vec![5]]);
    }
}
