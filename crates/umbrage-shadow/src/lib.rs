//! The shadow algorithms: receiver and map to the fraction in shadow.
